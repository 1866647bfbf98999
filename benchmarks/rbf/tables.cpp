#include "tables.hpp"

#include <exception>
#include <iostream>
#include <string>

/// What Cervenka 2024 studied of radial basis functions, with this project's own, as tables.
int main(int count, char** arguments) {
  gracilis::TableRequest request;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    if (word == "--thin")
      request.thin = true;
    else if (word == "--data" && i + 1 < count)
      request.data = arguments[++i];
    else if (request.out.empty() && word.rfind("--", 0) != 0)
      request.out = word;
    else
      request.out.clear(), i = count;
  }
  if (!std::filesystem::is_directory(request.out)) {
    std::cerr << "usage: gracilis_rbf_tables FOLDER [--thin] [--data FOLDER]: a .csv each, in a folder that is there\n";
    return 2;
  }
  try {
    for (const auto& write :
         {gracilis::write_kernels, gracilis::write_conditions, gracilis::write_signals, gracilis::write_fields,
          gracilis::write_solids, gracilis::write_curvature, gracilis::write_outlines})
      write(request);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
