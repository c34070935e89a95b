/// Physical quantities as users write them ("24 um", "22 mPa s", "1.6 1/s"), converted by UDUNITS-2. Units
/// exist only here, at the border of the program.
#pragma once

#include <string>
#include <string_view>

namespace hemoflux::apps {

/// The number that `text` means when expressed in `unit`: quantity("22 mPa s", "Pa s") is 0.022.
/// The text is a number, a space (optional) and a unit that UDUNITS-2 knows. Throws InputError when the text
/// has no number or no unit, the unit is unknown, or it measures something else than `unit`; FileError when
/// the UDUNITS database cannot be read. May be called from several threads.
double quantity(std::string_view text, const std::string& unit);

/// Factor from `from` to `to`: conversion("mm", "um") is 1000. Throws like quantity().
double conversion(const std::string& from, const std::string& to);

}  // namespace hemoflux::apps
