#pragma once

#include <map>
#include <string>
#include <vector>

/// Reader of the reference tables in tests/data: `#` provenance lines, one header row,
/// comma-separated rows. Values are SI or the units that the provenance lines give.

namespace ballast::exact {

class ReferenceTable {
public:
  /// Throws std::runtime_error if the file cannot be read or a row has the wrong number of cells.
  explicit ReferenceTable(const std::string& path);

  [[nodiscard]] std::size_t row_count() const { return rows_.size(); }
  /// Throws std::out_of_range for an unknown column.
  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const;
  /// Throws std::invalid_argument if the cell is no number.
  [[nodiscard]] double number(std::size_t row, const std::string& column) const;
  /// First row whose `column` holds `value`; throws std::out_of_range if there is none.
  [[nodiscard]] std::size_t find(const std::string& column, const std::string& value) const;

private:
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
};

} // namespace ballast::exact
