#include <floc/floc.h>

#include <iostream>

/// Prints the row of `floc moduli` for a state.
int main(int, char** argv) {
  const floc::AnyState state = floc::read_state(argv[1]);
  floc::write_table(std::cout, floc::moduli_table(state, {}, argv[1]), floc::TableFormat::csv);
}
