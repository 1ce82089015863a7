// Tone maps: radiance to what a display shows, and the scale on which differences are seen.
#pragma once

#include "base/color.h"
#include "base/image.h"

namespace chiaro {

/// The s-shaped operator of Tumblin, Hodgins and Guenter (TOG 18(1), 1999) for `x` = luminance over
/// the adaptation luminance: (x + 1/k) / (x + k) with k = 32, that is a sigmoid in log x with 1/k
/// at x = 1, rescaled so that 0 maps to 0. Result in [0, 1).
float tumblin_s_curve(float x);

/// The paper's one number for a colour in 4.1: the operator a channel, weighted 5/16, 9/16, 2/16.
/// `exposure` multiplies the colour first, so that a mid grey becomes the operator's x = 1.
float paper_tone_value(Rgb color, float exposure);

/// The curve on which pictures are compared: (1 - exp(-x))^(1/2.2), x >= 0, result in [0, 1).
float comparison_curve(float x);
/// Its derivative, bounded near 0.
float comparison_slope(float x);

/// Scale that takes the median of the non-zero luminances of `image` to 0.4; 1 if all are zero.
float comparison_exposure(const Image& image);

/// A picture for the screen: exposure, a filmic shoulder that keeps hue, the sRGB curve. Values in
/// [0, 1], encoded.
Image tone_mapped(const Image& linear, float exposure);

/// Exposure that shows `linear` well: its median becomes a mid grey, unless a tenth of the picture
/// would then be over white, as where a bright room is seen from a dark one. 1 for a black picture.
float automatic_exposure(const Image& linear);

}  // namespace chiaro
