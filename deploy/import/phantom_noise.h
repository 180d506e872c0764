#pragma once
// Noise of made images.

namespace palpate {

/// Nearly normal, of unit variance, from the cell's place alone: the sum of four uniform numbers.
double noise_at(int i, int j, int k);

}  // namespace palpate
