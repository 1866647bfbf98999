#include <gracilis/scene/setting_table.hpp>

#include <array>
#include <charconv>
#include <cmath>

namespace gracilis {

// The names of choices, in the order of their enumerations.
static constexpr std::array<std::string_view, 2> choices_of(TimeMode) { return {"quasi_static", "dynamic"}; }
static constexpr std::array<std::string_view, 2> choices_of(DihedralFormula) { return {"atan2", "arccos"}; }
static constexpr std::array<std::string_view, 4> choices_of(FiberTemplate) {
  return {"parallel", "pennate", "curved", "fan"};
}
static constexpr std::array<std::string_view, 3> choices_of(MuscleContact) {
  return {"none", "surface", "virtual-edges"};
}
static constexpr std::array<std::string_view, 3> choices_of(VirtualEdgeResolution) {
  return {"push", "unit_sum", "vector_sum"};
}
static constexpr std::array<std::string_view, 3> choices_of(CoincidingEdges) { return {"keep", "drop", "reseed"}; }
static constexpr std::array<std::string_view, 3> choices_of(TunnellingGuard) {
  return {"none", "turned_direction", "kept_path"};
}

static constexpr std::array<std::string_view, 2> choices_of(Skinning) { return {"strings", "bodies"}; }
static constexpr std::array<std::string_view, 2> choices_of(SurfacePaths) { return {"along_fibers", "nearest_joined"}; }

template <class T>
constexpr bool is_choice = std::is_enum_v<T>;

std::string to_text(Real value) {
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  std::string text(buffer, result.ptr);
  // TOML tells floats from integers by the point or the exponent.
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
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

template <class Settings>
SettingValue value_of(const Settings& settings, const Setting<Settings>& setting) {
  return std::visit(
      [&](auto member) -> SettingValue {
        const auto& value = settings.*member;
        if constexpr (is_choice<std::decay_t<decltype(value)>>) {
          return std::string(choices_of(value)[static_cast<std::size_t>(value)]);
        } else {
          return value;
        }
      },
      setting.member);
}

template <class Settings>
std::string expectation(const Setting<Settings>& setting) {
  const std::string range = range_text(setting.minimum, setting.maximum);
  const std::string unit = setting.unit.empty() ? "" : " " + std::string(setting.unit);
  return std::visit(
      [&]<class T>(T Settings::*) -> std::string {
        if constexpr (std::is_same_v<T, bool>) {
          return "true or false";
        } else if constexpr (std::is_same_v<T, int>) {
          return "an integer " + range + unit;
        } else if constexpr (std::is_same_v<T, Real>) {
          return "a number " + range + unit;
        } else if constexpr (std::is_same_v<T, Vec3>) {
          return "three numbers " + range + unit;
        } else if constexpr (std::is_same_v<T, std::string>) {
          return "a text in quotes";
        } else {
          std::string text = "one of";
          for (std::string_view choice : choices_of(T{}))
            text += (text.back() == 'f' ? " '" : ", '") + std::string(choice) + "'";
          return text;
        }
      },
      setting.member);
}

/// Converts `value` to T where that loses nothing and lies in the range.
template <class T>
static bool convert(const SettingValue& value, Real minimum, Real maximum, T& result) {
  const auto inside = [&](Real number) { return number >= minimum && number <= maximum; };
  if constexpr (is_choice<T>) {
    const std::string* name = std::get_if<std::string>(&value);
    const auto choices = choices_of(T{});
    for (std::size_t i = 0; name && i < choices.size(); ++i) {
      if (choices[i] != *name) continue;
      result = static_cast<T>(i);
      return true;
    }
    return false;
  } else if constexpr (std::is_same_v<T, Real>) {
    if (const int* integer = std::get_if<int>(&value))
      result = *integer;
    else if (const Real* number = std::get_if<Real>(&value))
      result = *number;
    else
      return false;
    return inside(result);
  } else {
    if (!std::holds_alternative<T>(value)) return false;
    result = std::get<T>(value);
    if constexpr (std::is_same_v<T, int>) return inside(result);
    if constexpr (std::is_same_v<T, Vec3>) return inside(result.x()) && inside(result.y()) && inside(result.z());
    return true;
  }
}

template <class Settings>
std::string assign(Settings& settings, const Setting<Settings>& setting, const SettingValue& value) {
  return std::visit(
      [&]<class T>(T Settings::*member) -> std::string {
        T converted{};
        if (!convert(value, setting.minimum, setting.maximum, converted)) return "must be " + expectation(setting);
        settings.*member = converted;
        return "";
      },
      setting.member);
}

template SettingValue value_of(const XpbdSettings&, const Setting<XpbdSettings>&);
template SettingValue value_of(const DistanceFieldSettings&, const Setting<DistanceFieldSettings>&);
template SettingValue value_of(const FiberSettings&, const Setting<FiberSettings>&);
template SettingValue value_of(const ContractionSettings&, const Setting<ContractionSettings>&);
template SettingValue value_of(const Sequence&, const Setting<Sequence>&);
template SettingValue value_of(const PrepareSettings&, const Setting<PrepareSettings>&);
template SettingValue value_of(const ContactSettings&, const Setting<ContactSettings>&);
template std::string expectation(const Setting<XpbdSettings>&);
template std::string expectation(const Setting<DistanceFieldSettings>&);
template std::string expectation(const Setting<FiberSettings>&);
template std::string expectation(const Setting<ContractionSettings>&);
template std::string expectation(const Setting<Sequence>&);
template std::string expectation(const Setting<PrepareSettings>&);
template std::string expectation(const Setting<ContactSettings>&);
template std::string assign(XpbdSettings&, const Setting<XpbdSettings>&, const SettingValue&);
template std::string assign(DistanceFieldSettings&, const Setting<DistanceFieldSettings>&, const SettingValue&);
template std::string assign(FiberSettings&, const Setting<FiberSettings>&, const SettingValue&);
template std::string assign(ContractionSettings&, const Setting<ContractionSettings>&, const SettingValue&);
template std::string assign(Sequence&, const Setting<Sequence>&, const SettingValue&);
template std::string assign(PrepareSettings&, const Setting<PrepareSettings>&, const SettingValue&);
template std::string assign(ContactSettings&, const Setting<ContactSettings>&, const SettingValue&);

}  // namespace gracilis
