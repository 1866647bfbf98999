#include <gracilis/io/hdf5_writer.hpp>

#include <gracilis/io/atomic_file.hpp>

#include <hdf5.h>

#include <utility>

namespace gracilis {

namespace {

/// An identifier of the library, closed with its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The library's words for the first thing that went wrong; it prints nothing by itself.
herr_t note_reason(unsigned number, const H5E_error2_t* error, void* reason) {
  if (number == 0 && error->desc) *static_cast<std::string*>(reason) = error->desc;
  return 0;
}

constexpr unsigned compression = 4;  // of 9: more takes longer and saves little

}  // namespace

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file, std::filesystem::path shown) : shown_(std::move(shown)) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  file_ = checked(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), "cannot be written");
}

Hdf5Writer::~Hdf5Writer() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Writer::fail(const std::string& what) const {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, &note_reason, &reason);
  throw_write_error(shown_, reason.empty() ? what : what + ": " + reason);
}

std::int64_t Hdf5Writer::checked(std::int64_t result, const std::string& what) const {
  if (result < 0) fail(what);
  return result;
}

void Hdf5Writer::write(const std::string& name, const std::vector<std::uint64_t>& shape, std::int64_t type,
                       const void* values) {
  const std::string what = "cannot be written at " + name;
  const std::vector<hsize_t> sizes(shape.begin(), shape.end());
  const Handle space(checked(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), what), H5Sclose);
  const Handle on_the_way(checked(H5Pcreate(H5P_LINK_CREATE), what), H5Pclose);
  checked(H5Pset_create_intermediate_group(on_the_way, 1), what);
  const Handle layout(checked(H5Pcreate(H5P_DATASET_CREATE), what), H5Pclose);
  if (sizes.size() == 3) {
    const hsize_t chunk[] = {1, sizes[1], sizes[2]};
    checked(H5Pset_chunk(layout, 3, chunk), what);
    checked(H5Pset_shuffle(layout), what);
    checked(H5Pset_deflate(layout, compression), what);
  }
  const Handle numbers(checked(H5Dcreate2(file_, name.c_str(), type, space, on_the_way, layout, H5P_DEFAULT), what),
                       H5Dclose);
  checked(H5Dwrite(numbers, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), what);
}

void Hdf5Writer::write(const std::string& name, const std::vector<std::uint64_t>& shape,
                       std::span<const double> values) {
  write(name, shape, H5T_NATIVE_DOUBLE, values.data());
}

void Hdf5Writer::write(const std::string& name, const std::vector<std::uint64_t>& shape,
                       std::span<const float> values) {
  write(name, shape, H5T_NATIVE_FLOAT, values.data());
}

void Hdf5Writer::write(const std::string& name, const std::vector<std::uint64_t>& shape,
                       std::span<const std::int32_t> values) {
  write(name, shape, H5T_NATIVE_INT32, values.data());
}

void Hdf5Writer::make_group(const std::string& name) {
  const std::string what = "cannot be written at " + name;
  const Handle on_the_way(checked(H5Pcreate(H5P_LINK_CREATE), what), H5Pclose);
  checked(H5Pset_create_intermediate_group(on_the_way, 1), what);
  const Handle group(checked(H5Gcreate2(file_, name.c_str(), on_the_way, H5P_DEFAULT, H5P_DEFAULT), what), H5Gclose);
}

void Hdf5Writer::remove(const std::string& name) {
  if (H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0)
    checked(H5Ldelete(file_, name.c_str(), H5P_DEFAULT), "cannot be written at " + name);
}

static hid_t text_type() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

void Hdf5Writer::describe(const std::string& object, const std::string& attribute, const std::string& text) {
  const std::string what = "cannot be written at " + object;
  const Handle type(text_type(), H5Tclose), space(checked(H5Screate(H5S_SCALAR), what), H5Sclose);
  const Handle written(checked(H5Acreate_by_name(file_, object.c_str(), attribute.c_str(), type, space, H5P_DEFAULT,
                                                 H5P_DEFAULT, H5P_DEFAULT),
                               what),
                       H5Aclose);
  const char* const pointer = text.c_str();
  checked(H5Awrite(written, type, &pointer), what);
}

void Hdf5Writer::describe(const std::string& object, const std::string& attribute,
                          const std::vector<std::string>& texts) {
  if (texts.empty()) return;
  const std::string what = "cannot be written at " + object;
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const hsize_t count = pointers.size();
  const Handle type(text_type(), H5Tclose), space(checked(H5Screate_simple(1, &count, nullptr), what), H5Sclose);
  const Handle written(checked(H5Acreate_by_name(file_, object.c_str(), attribute.c_str(), type, space, H5P_DEFAULT,
                                                 H5P_DEFAULT, H5P_DEFAULT),
                               what),
                       H5Aclose);
  checked(H5Awrite(written, type, pointers.data()), what);
}

void Hdf5Writer::close() {
  checked(H5Fflush(file_, H5F_SCOPE_GLOBAL), "cannot be written");
  const hid_t file = std::exchange(file_, -1);
  checked(H5Fclose(file), "cannot be written");
}

}  // namespace gracilis
