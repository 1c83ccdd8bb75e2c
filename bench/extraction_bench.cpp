#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "adit/extraction/extraction.hpp"
#include "adit/geometry/segment.hpp"
#include "adit/simulation/mine_worlds.hpp"
