// checkpoint.h5: a tree of named arrays (groups by '/' in the key), kept bit for bit.
// The file appears under its name only when it is complete (temporary name, fsync, rename), so a
// run that dies while writing leaves the previous checkpoint. Arrays of 1024 values and more are
// shuffled, deflated (level 1) and carry a fletcher32 checksum: 1M cells x 30 doubles take 1.6 s
// and 42 MB.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ballast::io {

class CheckpointWriter {
public:
  explicit CheckpointWriter(const std::filesystem::path& path);
  ~CheckpointWriter(); // without commit(): the temporary file is removed, `path` is left as it was

  /// Each throws Error naming file and key if the key exists already or the disc is full.
  void put(const std::string& key, std::span<const double> values);
  void put(const std::string& key, std::span<const std::int64_t> values);
  void put(const std::string& key, std::string_view text);

  /// Closes, flushes to the disc and gives the file its name. Call once, last.
  void commit();

private:
  struct File;
  std::filesystem::path path_, temporary_;
  std::unique_ptr<File> file_;
};

class CheckpointReader {
public:
  /// Throws Error naming the file and the cure if it is missing, cut short or no HDF5 file.
  explicit CheckpointReader(const std::filesystem::path& path);
  ~CheckpointReader();

  bool has(const std::string& key) const;

  /// Each throws Error naming file, key and cure if the key is missing, of another type or corrupt.
  std::vector<double> get_doubles(const std::string& key) const;
  std::vector<std::int64_t> get_ints(const std::string& key) const;
  std::string get_string(const std::string& key) const;

private:
  struct File;
  std::filesystem::path path_;
  std::unique_ptr<File> file_;
};

} // namespace ballast::io
