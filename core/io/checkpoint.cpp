#include "core/io/checkpoint.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <hdf5.h>
#include <utility>

#include "core/error.hpp"
#include "core/io/summary.hpp"

namespace ballast::io {
namespace {

constexpr std::size_t compress_from = 1024; // values; below, a chunk index costs more than it saves
constexpr std::size_t chunk_values = 128 * 1024; // 1 MiB of doubles: HDF5's default chunk cache

/// An HDF5 identifier that closes itself.
class Handle {
public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0)
      close_(id_);
  }
  bool valid() const { return id_ >= 0; }
  operator hid_t() const { return id_; }

private:
  hid_t id_;
  Close close_;
};

/// Keeps HDF5 from printing its own stack while it lives: our Error says what is needed.
class QuietHdf5 {
public:
  QuietHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

Handle creation_list(std::size_t count) {
  Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (count >= compress_from) {
    const hsize_t chunk = std::min(count, chunk_values);
    H5Pset_chunk(list, 1, &chunk);
    H5Pset_shuffle(list);
    H5Pset_deflate(list, 1);
    H5Pset_fletcher32(list);
  }
  return list;
}

struct Stored {
  hid_t type;
  hid_t space;
  std::size_t count;
  const void* data;
};

bool write_dataset(hid_t file, const std::string& key, const Stored& stored) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Handle creation = creation_list(stored.count);
  const Handle set(
      H5Dcreate2(file, key.c_str(), stored.type, stored.space, links, creation, H5P_DEFAULT),
      H5Dclose);
  return set.valid() &&
         (stored.count == 0 ||
          H5Dwrite(set, stored.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, stored.data) >= 0);
}

bool write_array(
    hid_t file, const std::string& key, hid_t type, const void* data, std::size_t count) {
  const hsize_t extent = count;
  const Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  return write_dataset(file, key, {type, space, count, data});
}

bool key_exists(hid_t file, const std::string& key) {
  if (key.empty())
    return false;
  for (std::size_t slash = key.find('/', 1); slash != std::string::npos;
       slash = key.find('/', slash + 1))
    if (H5Lexists(file, key.substr(0, slash).c_str(), H5P_DEFAULT) <= 0)
      return false;
  return H5Lexists(file, key.c_str(), H5P_DEFAULT) > 0;
}

std::string
failed_key(const std::filesystem::path& path, const std::string& key, const char* what) {
  return fmt::format(
      "checkpoint {}: key '{}' {}. Restart from another checkpoint, one written by this "
      "version of Ballast with the same deck, or start the run anew.",
      path.string(),
      key,
      what);
}

Handle open_dataset(hid_t file,
                    const std::filesystem::path& path,
                    const std::string& key,
                    H5T_class_t expected) {
  if (!key_exists(file, key))
    throw Error(failed_key(path, key, "is missing"));
  Handle set(H5Dopen2(file, key.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid())
    throw Error(failed_key(path, key, "is no array"));
  const Handle type(H5Dget_type(set), H5Tclose);
  if (H5Tget_class(type) != expected)
    throw Error(failed_key(path, key, "holds another type of data"));
  return set;
}

template <class T>
std::vector<T>
read_array(hid_t file, const std::filesystem::path& path, const std::string& key, hid_t type) {
  const Handle set = open_dataset(file, path, key, H5Tget_class(type));
  const Handle space(H5Dget_space(set), H5Sclose);
  std::vector<T> values(
      static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space))));
  if (!values.empty() && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw Error(failed_key(path, key, "is corrupt (its checksum or its data cannot be read)"));
  return values;
}

} // namespace

struct CheckpointWriter::File : Handle {};
struct CheckpointReader::File : Handle {};

CheckpointWriter::CheckpointWriter(const std::filesystem::path& path)
    : path_(path), temporary_(path.string() + ".tmp") {
  const QuietHdf5 quiet;
  if (path.has_parent_path())
    std::filesystem::create_directories(path.parent_path());
  file_ = std::make_unique<File>(
      File{{H5Fcreate(temporary_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose}});
  if (!file_->valid())
    throw Error(fmt::format(
        "checkpoint {}: cannot be created. Is the folder writable and the disc not full?",
        temporary_.string()));
}

CheckpointWriter::~CheckpointWriter() {
  if (!file_)
    return;
  const QuietHdf5 quiet;
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void CheckpointWriter::put(const std::string& key, std::span<const double> values) {
  const QuietHdf5 quiet;
  if (!write_array(*file_, key, H5T_NATIVE_DOUBLE, values.data(), values.size()))
    throw Error(failed_key(temporary_, key, "cannot be written (used twice, or the disc is full)"));
}

void CheckpointWriter::put(const std::string& key, std::span<const std::int64_t> values) {
  const QuietHdf5 quiet;
  if (!write_array(*file_, key, H5T_NATIVE_INT64, values.data(), values.size()))
    throw Error(failed_key(temporary_, key, "cannot be written (used twice, or the disc is full)"));
}

void CheckpointWriter::put(const std::string& key, std::string_view text) {
  const QuietHdf5 quiet;
  const std::string terminated(text);
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, terminated.size() + 1);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  if (!write_dataset(*file_, key, {type, space, 1, terminated.c_str()}))
    throw Error(failed_key(temporary_, key, "cannot be written (used twice, or the disc is full)"));
}

void CheckpointWriter::commit() {
  const QuietHdf5 quiet;
  const bool flushed = H5Fflush(*file_, H5F_SCOPE_GLOBAL) >= 0;
  file_.reset();
  if (!flushed) {
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
    throw Error(fmt::format("checkpoint {}: cannot be flushed. Free space on the disc.",
                            temporary_.string()));
  }
  sync_to_disc(temporary_);
  std::filesystem::rename(temporary_, path_);
}

CheckpointReader::CheckpointReader(const std::filesystem::path& path) : path_(path) {
  const QuietHdf5 quiet;
  if (!std::filesystem::exists(path))
    throw Error(fmt::format(
        "checkpoint {}: there is no such file. Name the checkpoint.h5 of a run directory.",
        path.string()));
  file_ =
      std::make_unique<File>(File{{H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose}});
  if (!file_->valid())
    throw Error(
        fmt::format("checkpoint {}: is corrupt, cut short or no HDF5 file. Restart from another "
                    "checkpoint, or start the run anew.",
                    path.string()));
}

CheckpointReader::~CheckpointReader() = default;

bool CheckpointReader::has(const std::string& key) const {
  const QuietHdf5 quiet;
  return key_exists(*file_, key);
}

std::vector<double> CheckpointReader::get_doubles(const std::string& key) const {
  const QuietHdf5 quiet;
  return read_array<double>(*file_, path_, key, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> CheckpointReader::get_ints(const std::string& key) const {
  const QuietHdf5 quiet;
  return read_array<std::int64_t>(*file_, path_, key, H5T_NATIVE_INT64);
}

std::string CheckpointReader::get_string(const std::string& key) const {
  const QuietHdf5 quiet;
  const Handle set = open_dataset(*file_, path_, key, H5T_STRING);
  const Handle type(H5Dget_type(set), H5Tclose);
  std::string text(H5Tget_size(type), '\0');
  if (text.empty() || H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
    throw Error(failed_key(path_, key, "is corrupt (its text cannot be read)"));
  text.pop_back();
  return text;
}

} // namespace ballast::io
