// Numbers by name in one file that numpy.load opens.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>

namespace billow {

/// What an NPZ file holds: matrices, and numbers that stand alone. Doubles are written and read back to the bit.
struct Npz {
  std::map<std::string, Eigen::MatrixXd> matrix;
  std::map<std::string, double> number;

  /// Throw InputError where there is none of that name.
  const Eigen::MatrixXd& matrix_at(const std::string& name) const;
  double number_at(const std::string& name) const;
};

/// Writes it whole or not at all; the same numbers give the same bytes. Throws OutputError.
void write_npz(const std::filesystem::path& file, const Npz& contents);

/// Reads a file that write_npz wrote. Throws InputError, with the file's name, on one that is damaged or of other
/// arrays.
Npz read_npz(const std::filesystem::path& file);

}  // namespace billow
