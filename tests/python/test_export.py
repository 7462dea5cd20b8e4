"""Tests floc export for a state of every kind of scene: the printed command restores the state."""
import os
import pathlib
import subprocess
import unittest

import numpy as np

import floc
import samples

# Scenes of rigid grains are left out, because making their states takes minutes.
SCENES = [scene for scene in sorted((samples.SOURCE / "data/scenes").glob("*.toml"))
          if 'normal = {law = "rigid"}' not in scene.read_text(encoding="utf-8")]
LISTED = ("cemented2d", "cemented3d")  # whose diameters are in a file, one for each grain of many
VARIANTS = {"wet_demo": ("contact.adhesion.formation=contact", "contact.adhesion.form=rational")}
EXACT = ("id1", "id2", "image", "gap", "normal_force", "rolling_moment", "twisting_moment", "kn", "kt", "kr", "ktw", "distant")


def shell(command, where):
    programs = samples.directory() / "programs"
    programs.mkdir(exist_ok=True)
    if not (programs / "floc").exists():
        (programs / "floc").symlink_to(pathlib.Path(samples.PROGRAM).resolve())
    return subprocess.run(["/bin/sh", "-c", command], capture_output=True, text=True, cwd=where, check=False,
                          env={**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"})


class Export(unittest.TestCase):
    def round_trip(self, state, where, grains="g.csv", contacts="c.csv"):
        where.mkdir(exist_ok=True)
        done = subprocess.run([samples.PROGRAM, "export", state, "--grains", grains, "--contacts", contacts],
                              capture_output=True, text=True, cwd=where, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        command = done.stderr.split("The following command restores the state:\n")[1].strip()
        (where / "STATE.h5").unlink(missing_ok=True)
        again = shell(command, where)
        self.assertEqual(again.returncode, 0, command + "\n" + again.stderr)
        self.assertNotIn("listed liquid bridges sum to", again.stderr)
        return where / "STATE.h5"

    def same(self, state, again):
        a, b = floc.read(state), floc.read(again)
        for name in ("position", "radius", "mass", "cell", "ids", "target_stress"):
            np.testing.assert_array_equal(getattr(b, name), getattr(a, name), name)
        self.assertEqual(b.law, a.law)
        self.assertEqual(b.n_contacts, a.n_contacts)
        for name in EXACT:
            np.testing.assert_array_equal(b.contacts[name], a.contacts[name], name)
        forces = np.abs(a.contacts["normal_force"]).max()
        np.testing.assert_allclose(b.contacts["shear_force"], a.contacts["shear_force"], rtol=0, atol=1e-14 * forces)
        if "bridge_volume" in a.contacts.dtype.names:
            np.testing.assert_array_equal(b.contacts["bridge_volume"], a.contacts["bridge_volume"])
        rows = [samples.rows_of("network", file, "--columns", "n_contacts,n_distant,z,P")[0] for file in (state, again)]
        pressure = [row.pop("P") for row in rows]
        self.assertEqual(rows[0], rows[1])
        self.assertAlmostEqual(pressure[0], pressure[1], delta=1e-14 * forces / a.radius.max() ** (a.dimension - 1))
        bulk = [samples.rows_of("moduli", file, "--force", "--columns", "B")[0]["B"] for file in (state, again)]
        if bulk[0] is None:
            self.assertIsNone(bulk[1])
        else:
            self.assertAlmostEqual(bulk[1], bulk[0], delta=1e-9 * abs(bulk[0]))
        verified = [subprocess.run([samples.PROGRAM, "verify", file], capture_output=True, text=True, check=False).returncode
                    for file in (state, again)]
        self.assertEqual(verified[0], verified[1])

    def test_of_every_shipped_scene_gives_the_state_back(self):
        cases = [(scene, ()) for scene in SCENES]
        cases += [(samples.SOURCE / f"data/scenes/{name}.toml", (change,)) for name, changes in VARIANTS.items()
                  for change in changes]
        n_states = n_wet = n_across = n_walls = 0
        for k, (scene, changes) in enumerate(cases):
            with self.subTest(scene=scene.stem, changes=changes):
                few = ["--set", "grains.count=24"]
                if scene.stem in LISTED:
                    few += ["--set", 'grains.diameter={distribution="uniform",min=0.5,max=1.0}']
                for change in changes:
                    few += ["--set", change]
                run = samples.directory() / f"export-{k}"
                samples.floc_program("run", scene, "-o", run, *few, "--until", 4)
                files = sorted(run.glob("state-*.h5"))
                n_walls += bool(floc.read(files[-1]).walls)
                for state in files[::max(1, len(files) - 1)]:
                    self.same(state, self.round_trip(state, samples.directory() / "export"))
                    contacts = floc.read(state).contacts
                    n_states += 1
                    if "bridge_volume" in contacts.dtype.names:
                        n_wet += (contacts["bridge_volume"] != 0).any()
                        n_across += ((contacts["bridge_volume"] != 0) & (contacts["gap"] > 0)).sum()
        print(f"\n{len(cases)} scenes, {n_states} states exported and made again, {n_wet} wet with {n_across} bridges across gaps, "
              f"{n_walls} of boxes")
        self.assertGreater(n_across, 0)

    def test_prints_a_command_for_any_names(self):
        state = samples.last_state("powder")
        for grains, contacts in (("a b.csv", "it's.csv"), ("grains.txt", "c$d.dat"), ("g", "(c)")):
            self.same(state, self.round_trip(state, samples.directory() / "names", grains, contacts))


class BridgeVolumes(unittest.TestCase):
    LAW = ("normal.stiffness=1000,adhesion.law=capillary,adhesion.surface_tension=1,adhesion.contact_angle=0,"
           "adhesion.water_content=0.01,adhesion.density_ratio=2.5,adhesion.form=exponential,adhesion.formation=gap")

    def test_that_are_not_those_of_the_law_are_said_to(self):
        where = samples.directory()
        (where / "w.csv").write_text("x,y,radius\n0,0,0.5\n1.001,0,0.5\n", encoding="utf-8")
        volume = 0.01 * 2.5 * 2 * np.pi / 6
        for share, said in ((1.0, False), (0.9, True)):
            (where / "v.csv").write_text(f"id1,id2,bridge_volume\n0,1,{share * volume!r}\n", encoding="utf-8")
            done = subprocess.run([samples.PROGRAM, "convert", "w.csv", "w.h5", "--cell", "4,0;0,4", "--law", self.LAW, "--contacts",
                                   "v.csv", "--overwrite"], capture_output=True, text=True, cwd=where, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual("the volumes of the listed liquid bridges sum to" in done.stderr, said)
            self.assertEqual(floc.read(where / "w.h5").contacts["bridge_volume"][0], share * volume)
        done = subprocess.run([samples.PROGRAM, "convert", "w.csv", "w.h5", "--cell", "4,0;0,4", "--law", "normal.stiffness=1",
                               "--contacts", "v.csv", "--overwrite"], capture_output=True, text=True, cwd=where, check=False)
        self.assertEqual(done.returncode, 4)
        self.assertIn("v.csv:2: bridge_volume = 0.0235", done.stderr)


if __name__ == "__main__":
    unittest.main()
