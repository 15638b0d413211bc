// `gnomon doctor`: what this machine offers, and why something does not work.
#pragma once

namespace gnomon::tool {

/// Prints it as text or as one line of JSON. Exit code 0 where a context was found, else 2.
int run_doctor(bool json);

}  // namespace gnomon::tool
