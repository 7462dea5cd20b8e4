#pragma once

#include <string>

namespace floc {

/// Threads that shorten the time steps of so many grains: at most those that are asked for, and one for each 1400
/// disks or 500 spheres, but always one. Of fewer grains a thread has so little to do in a step that threads wait for
/// each other longer: measured with two threads, a step of 1400 disks takes 1.6 times as long as with one, of 2800
/// disks 0.8 times, of 1400 spheres 0.85 times and of 2800 spheres 0.75 times. Results do not depend on it.
/// @param n_grains   >= 0
/// @param dimension  2 or 3
/// @param asked      >= 1
int useful_threads(int n_grains, int dimension, int asked);

/// The threads that a run leaves unused and why, in words, such as "1400 disks: 1 of 2 threads is used, ..."; empty
/// where all that are asked for are useful. The arguments are those of useful_threads().
std::string unused_threads(int n_grains, int dimension, int asked);

}  // namespace floc
