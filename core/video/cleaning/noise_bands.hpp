// Splits a picture into bands of scale, in which noise and shapes are weighed against each other.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace dibhr {

inline constexpr std::size_t kNoiseBands = 5;

/// The share of white noise's variance that each band has.
inline constexpr std::array<float, kNoiseBands> kWhiteBands{0.887F, 0.053F, 0.010F, 0.002F, 0.001F};

/// A picture, or one of its bands.
struct BandPicture {
    int columns{0};
    int rows{0};
    std::vector<float> values{};  ///< row-major

    void set_size(int new_columns, int new_rows);
    /// Above the first row it is the first one, below the last the last one.
    [[nodiscard]] float* row(int number) { return values.data() + index_of_row(number); }
    [[nodiscard]] const float* row(int number) const {
        return values.data() + index_of_row(number);
    }

  private:
    [[nodiscard]] std::size_t index_of_row(int number) const;
};

/// The variance of noise in a picture, of every second column and row: a part that has the shares
/// `moving` in the bands, and one, maybe of no pixels, that has `standing`.
struct BandNoise {
    BandPicture moving{}, standing{};
    std::array<float, kNoiseBands> moving_shares{}, standing_shares{};
    float stated{0.0F};  ///< deviation that may be left, whatever it is
};

/// A Laplacian pyramid (P. Burt and E. Adelson, IEEE Transactions on Communications 31, 1983). Band
/// b has shapes of about 2 * 2^b to 4 * 2^b pixels a period; planes are in none. The same picture
/// gives the same bits. Scratch memory is kept inside.
class NoiseBands {
  public:
    /// Splits `picture`, which has no NaN and at least one pixel.
    void split(const BandPicture& picture);

    /// Leaves of `picture` what is more than noise: each band by as much as its energy around a
    /// pixel is beyond the noise of that band; and of the noise what may be left. What is coarser
    /// than all bands has at most the noise of the last one.
    void keep_shapes(BandPicture& picture, const BandNoise& noise);

    /// The sum of the bands of `picture`, each times its factor; what is coarser is in none.
    void weigh(BandPicture& picture, const std::array<float, kNoiseBands>& factors);

    /// Of every 2^number-th column and row.
    [[nodiscard]] const BandPicture& band(std::size_t number) const { return bands_[number]; }

  private:
    void find_gains(std::size_t band, const BandNoise& noise);

    std::array<BandPicture, kNoiseBands> bands_{}, coarser_{};
    BandPicture energy_{};  ///< of one band
    std::array<BandPicture, kNoiseBands> moving_{}, standing_{}, gains_{};
    std::vector<float> row_{}, wide_{}, wide_gain_{};
};

}  // namespace dibhr
