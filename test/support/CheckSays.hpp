#pragma once
#include <support/Texts.hpp>

/// Asserts that the text `problems` contains `part`, and prints the whole text if it does not.
#define SUTURE_CHECK_SAYS(problems, part)                                                    \
  do {                                                                                       \
    const std::string suture_whole = problems, suture_part = part;                           \
    const bool suture_found = texts::contains(suture_whole, suture_part);                    \
    if (!suture_found) out << "not in the message: " << suture_part << "\n" << suture_whole; \
    TEST_ASSERT(suture_found);                                                               \
  } while (false)
