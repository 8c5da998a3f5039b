// history.csv: one row a sample, time in the first column (named exactly `t`, in s), the SI unit of
// every other column in its header: `t,velocity_bullet [m/s],energy_total [J]`. Values are printed
// with %.17g, so they read back bit for bit.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ballast::io {

class HistoryWriter {
public:
  /// Starts a new file. `columns` are the headers after `t`, such as "velocity_bullet [m/s]".
  HistoryWriter(const std::filesystem::path& path, const std::vector<std::string>& columns);

  /// Goes on after a restart: keeps the rows with t <= `time`, drops the rest and any half-written
  /// last row. Throws Error if the header on file is not that of `columns`. A missing file is
  /// started anew.
  static HistoryWriter
  reopen(const std::filesystem::path& path, const std::vector<std::string>& columns, double time);

  /// Adds and flushes one row; `values` holds one value for each column after `t`. Throws Error.
  void add(double t, std::span<const double> values);

private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  HistoryWriter(const std::filesystem::path& path, std::size_t columns, const std::string& text);

  std::filesystem::path path_;
  std::size_t columns_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// A file of numbers with named columns.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns; // columns[c][row]

  /// The column called `name`, with or without its unit; nullptr if there is none.
  const std::vector<double>* find(std::string_view name) const;
};

/// "velocity_bullet [m/s]" -> {"velocity_bullet", "m/s"}; the unit of `t` is s; no unit gives "".
struct ColumnName {
  std::string name, unit;
};
ColumnName split_column_name(std::string_view header);

/// Reads a history file; an unfinished last row is ignored. Throws Error naming file, line and what
/// was found.
Table read_csv(const std::filesystem::path& path);

} // namespace ballast::io
