// How far one picture is from another.
#pragma once

#include "base/image.h"

namespace chiaro {

struct ImageDifference {
    double psnr = 0;    // of (1 - exp(-x))^(1/2.2) [dB]; infinite for equal pictures
    double relmse = 0;  // mean of (a - b)^2 / (b^2 + 0.01)
    double rmse = 0;
    double k = 1;  // both pictures were multiplied by this: 0.4 / median non-zero luminance of b
};

/// Error of linear picture `a` against `b`, over all pixels and colour channels, after both are
/// scaled by k. Throws an Error if sizes differ or a value is not finite.
ImageDifference difference(const Image& a, const Image& b);

/// As difference(), against the mean of two independent halves of a reference. Each square becomes
/// the product of the differences from either half, in which the reference's own noise cancels on
/// average; a sum that noise makes negative counts as 0.
ImageDifference difference(const Image& a, const Image& half_1, const Image& half_2);

}  // namespace chiaro
