#include <gracilis/io/value_reader.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace gracilis {

static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

template <typename Number>
static bool parse(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool parse_number(std::string_view text, double& value) { return parse(text, value); }
bool parse_integer(std::string_view text, long long& value) { return parse(text, value); }

bool parse_index(std::string_view text, Index& value) {
  long long number = 0;
  const std::optional<Index> index = parse(text, number) ? whole_number<Index>(number, 0) : std::nullopt;
  value = index.value_or(0);
  return index.has_value();
}

std::string_view ValueReader::word() {
  while (position_ < bytes_.size() && is_space(bytes_[position_])) ++position_;
  word_begin_ = position_;
  while (position_ < bytes_.size() && !is_space(bytes_[position_])) ++position_;
  return bytes_.substr(word_begin_, position_ - word_begin_);
}

std::string_view ValueReader::line() {
  word_begin_ = position_;
  const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
  std::string_view text = bytes_.substr(position_, end - position_);
  position_ = std::min(end + 1, bytes_.size());
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

template <typename Stored>
static double stored_number(const char* bytes, bool swap) {
  char copy[sizeof(Stored)];
  std::memcpy(copy, bytes, sizeof(Stored));
  if (swap) std::reverse(copy, copy + sizeof(Stored));
  Stored value;
  std::memcpy(&value, copy, sizeof(Stored));
  return static_cast<double>(value);
}

std::size_t size_of(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
    case ScalarType::uint8:
      return 1;
    case ScalarType::int16:
    case ScalarType::uint16:
      return 2;
    case ScalarType::int32:
    case ScalarType::uint32:
    case ScalarType::float32:
      return 4;
    default:
      return 8;
  }
}

static double decode(const char* bytes, ScalarType type, bool swap) {
  switch (type) {
    case ScalarType::int8:
      return stored_number<std::int8_t>(bytes, swap);
    case ScalarType::uint8:
      return stored_number<std::uint8_t>(bytes, swap);
    case ScalarType::int16:
      return stored_number<std::int16_t>(bytes, swap);
    case ScalarType::uint16:
      return stored_number<std::uint16_t>(bytes, swap);
    case ScalarType::int32:
      return stored_number<std::int32_t>(bytes, swap);
    case ScalarType::uint32:
      return stored_number<std::uint32_t>(bytes, swap);
    case ScalarType::int64:
      return stored_number<std::int64_t>(bytes, swap);
    case ScalarType::uint64:
      return stored_number<std::uint64_t>(bytes, swap);
    case ScalarType::float32:
      return stored_number<float>(bytes, swap);
    default:
      return stored_number<double>(bytes, swap);
  }
}

double ValueReader::number(ScalarType type) {
  if (encoding == Encoding::text) {
    const std::string_view text = word();
    double value = 0;
    if (text.empty()) fail("ends before all announced numbers");
    if (!parse_number(text, value)) fail(fmt::format("'{}' is not a number", text.substr(0, 40)));
    return value;
  }
  const std::size_t size = size_of(type);
  if (bytes_.size() - position_ < size) fail("ends before all announced numbers");
  const bool swap = (encoding == Encoding::big_endian) != (std::endian::native == std::endian::big);
  read_binary_ = true;
  const double value = decode(bytes_.data() + position_, type, swap);
  position_ += size;
  return value;
}

std::size_t ValueReader::count(std::string_view text, std::size_t bytes_each) {
  long long value = 0;
  if (!parse_integer(text, value) || value < 0) fail(fmt::format("'{}' is not a count", text.substr(0, 40)));
  const auto amount = static_cast<std::size_t>(value);
  if (amount > (bytes_.size() - position_) / bytes_each) {
    fail(fmt::format("announces {} elements, more than the rest of the file can hold", amount));
  }
  return amount;
}

std::size_t ValueReader::line_number() const {
  return 1 +
         static_cast<std::size_t>(std::count(bytes_.begin(), bytes_.begin() + static_cast<long>(word_begin_), '\n'));
}

void ValueReader::fail(const std::string& what, const std::string& remedy) const {
  const std::string where = read_binary_ ? fmt::format("byte {}", position_) : fmt::format("{}", line_number());
  throw InputError({path_.string(), where, what, remedy});
}

}  // namespace gracilis
