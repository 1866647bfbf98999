#include <gracilis/draft/guess.hpp>

#include <fmt/format.h>

namespace gracilis {

std::string to_string(const Guess& guess) { return fmt::format("{}, certainty {:.2f}", guess.how, guess.certainty); }

}  // namespace gracilis
