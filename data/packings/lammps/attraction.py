"""Tables for pair_style table of an attraction of 1 in contact, none across a gap:  python3 attraction.py > attraction.table"""
FORCE, POINTS = 1.0, 1001
for name, contact in ("LARGE", 1.0), ("BOTH", 0.85), ("SMALL", 0.7):
    first = 0.9 * contact
    print(f"{name}\nN {POINTS} R {first} {contact}\n")
    for k in range(POINTS):
        r = first + (contact - first) * k / (POINTS - 1)
        print(k + 1, repr(r), repr(-FORCE * (contact - r)), -FORCE)
    print()
