#include <gracilis/scene/setting_table.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace gracilis {

std::string to_text(Real value) {
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  std::string text(buffer, result.ptr);
  // TOML tells floats from integers by the point or the exponent.
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

Real shortest_decimal(float value) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  Real decimal = 0;
#ifdef __wasm__
  *end = 0;
  decimal = std::strtod(buffer, nullptr);  // clang's library there reads no floats; its locale is always C
#else
  std::from_chars(buffer, end, decimal);
#endif
  return decimal;
}

static std::string range_text(Real minimum, Real maximum) {
  const auto plain = [](Real value) {
    if (value == std::floor(value) && std::abs(value) <= 1e6) return std::to_string(static_cast<long>(value));
    return to_text(value);
  };
  return "from " + plain(minimum) + " to " + plain(maximum);
}

std::string to_text(const SettingValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const int* integer = std::get_if<int>(&value)) return std::to_string(*integer);
  if (const Real* number = std::get_if<Real>(&value)) return to_text(*number);
  if (const Vec3* vector = std::get_if<Vec3>(&value)) {
    return "[" + to_text(vector->x()) + ", " + to_text(vector->y()) + ", " + to_text(vector->z()) + "]";
  }
  return "\"" + std::get<std::string>(value) + "\"";
}

std::string expectation(const SettingInfo& setting) {
  const std::string range =
      range_text(setting.minimum, setting.maximum) + (setting.unit.empty() ? "" : " " + std::string(setting.unit));
  switch (setting.kind) {
    case SettingKind::flag:
      return "true or false";
    case SettingKind::integer:
      return "an integer " + range;
    case SettingKind::number:
      return "a number " + range;
    case SettingKind::vector:
      return "three numbers " + range;
    case SettingKind::text:
      return "a text in quotes";
    case SettingKind::choice:
      break;
  }
  std::string text = "one of";
  for (const std::string_view choice : setting.choices)
    text += (text.back() == 'f' ? " '" : ", '") + std::string(choice) + "'";
  return text;
}

std::optional<SettingValue> accepted(const SettingInfo& setting, const SettingValue& value) {
  const auto inside = [&](Real number) { return number >= setting.minimum && number <= setting.maximum; };
  bool fits = false;
  switch (setting.kind) {
    case SettingKind::flag:
      fits = std::holds_alternative<bool>(value);
      break;
    case SettingKind::integer:
      fits = std::holds_alternative<int>(value) && inside(std::get<int>(value));
      break;
    case SettingKind::number:
      if (const int* integer = std::get_if<int>(&value)) return accepted(setting, static_cast<Real>(*integer));
      fits = std::holds_alternative<Real>(value) && inside(std::get<Real>(value));
      break;
    case SettingKind::vector:
      if (const Vec3* vector = std::get_if<Vec3>(&value))
        fits = inside(vector->x()) && inside(vector->y()) && inside(vector->z());
      break;
    case SettingKind::text:
      fits = std::holds_alternative<std::string>(value);
      break;
    case SettingKind::choice:
      fits = std::holds_alternative<std::string>(value) &&
             std::find(setting.choices.begin(), setting.choices.end(), std::get<std::string>(value)) !=
                 setting.choices.end();
      break;
  }
  return fits ? std::optional(value) : std::nullopt;
}

}  // namespace gracilis
