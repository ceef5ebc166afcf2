#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "endowire/rod/instrument.hpp"

namespace endowire::io {

/// One value of an instrument file and where it comes from.
struct SourcedValue {
  std::string field;   ///< `section[0].friction`
  std::string value;   ///< as read, `6 … 400` for a taper
  std::string source;  ///< `key: how it follows`, or `estimate: reasoning`
};

/// What a file of `instruments/` holds: the instrument and the origin of every number in it.
struct InstrumentFile {
  std::string path;
  std::string description;
  rod::Instrument instrument;
  std::vector<SourcedValue> values;
};

/// Reads an instrument from TOML:
///
///   schema = 1
///   model = "hydrophilic_035_angled"
///   description = "..."
///   [sources]                     # key = citation
///   harrison_2011 = "Harrison et al., J. Endovasc. Ther. 18:797, 2011"
///   [grip]
///   force_n = { value = 2.0, source = "estimate: ..." }
///   torque_n_mm = { value = 2.0, source = "estimate: ..." }
///   [[section]]                   # from the tip to the hand
///   length_mm = { value = 10.0, source = "..." }
///   flexural_rigidity_n_mm2 = { tip = 6.0, hand = 27.6, source = "..." }   # a taper; or value = for a
///   constant
///   ...                           # the fields of rod::Section, angles in degrees (rest_plane_deg)
///
/// Every value carries a `source`: a key of [sources], or `estimate`, alone or followed by `: reasoning`;
/// an estimate without reasoning is refused.
/// @throws base::InputError naming the file, field, value and what is allowed.
[[nodiscard]] InstrumentFile read_instrument_file(const std::filesystem::path& path);

/// Same, from text; `name` stands for the file in messages.
[[nodiscard]] InstrumentFile parse_instrument(const std::string& text, const std::string& name);

/// Names of the instruments in these folders, sorted, each once (the first folder that has it wins).
[[nodiscard]] std::vector<std::string> list_instruments(const std::vector<std::filesystem::path>& folders);

/// The file of a model name in these folders; empty when none has it.
[[nodiscard]] std::filesystem::path find_instrument(const std::string& model,
                                                    const std::vector<std::filesystem::path>& folders);

}  // namespace endowire::io
