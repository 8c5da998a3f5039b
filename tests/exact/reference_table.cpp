#include "tests/exact/reference_table.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ballast::exact {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    cells.push_back(cell);
  }
  return cells;
}

} // namespace

ReferenceTable::ReferenceTable(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') {
      continue;
    }
    std::vector<std::string> cells = split(line);
    if (columns_.empty()) {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        columns_[cells[i]] = i;
      }
    } else if (cells.size() == columns_.size()) {
      rows_.push_back(std::move(cells));
    } else {
      throw std::runtime_error(path + ": row of wrong length: " + line);
    }
  }
}

const std::string& ReferenceTable::text(std::size_t row, const std::string& column) const {
  return rows_.at(row).at(columns_.at(column));
}

double ReferenceTable::number(std::size_t row, const std::string& column) const {
  return std::stod(text(row, column));
}

std::size_t ReferenceTable::find(const std::string& column, const std::string& value) const {
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (text(row, column) == value) {
      return row;
    }
  }
  throw std::out_of_range("no row with " + column + " = " + value);
}

} // namespace ballast::exact
