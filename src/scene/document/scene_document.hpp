#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "../../text/scene_message.hpp"
#include "../study_reader.hpp"

namespace hamjet::io {

/// The TOML tables of a scene, and their origin.
struct SceneDocument {
  toml::table table;
  SceneSource source;
};

/// Parses the tables and applies the overrides, without any knowledge of the meaning of the keys.
/// `name` is the file's name for messages, already printable.
///
/// An override's key is a dotted path; an element of an array is named by its index from 0, or, if
/// it is a table, by its label: `integrator.0.tolerance`, `integrator.gauss8.tolerance`. Missing
/// tables on the way are added. The value is TOML; a value that is not valid TOML is taken as a
/// string. The value `null`, which TOML does not know, removes the key.
///
/// `implied`, in TOML, holds the tables and arrays that a document without them implies. An
/// override may name a key in one of these.
///
/// Throws Error(scene) if the text is not valid TOML (see also `check_scene_text`), and
/// Error(usage) if an override's key leads nowhere, its value is empty, or it takes away what an
/// earlier one gave.
SceneDocument parse_document(std::string_view text, const std::string& name,
                             const std::vector<Override>& overrides, std::string_view implied = {});

/// parse_document for tables that a program has made and that have no lines.
SceneDocument make_document(toml::table tables, const std::string& name,
                            const std::vector<Override>& overrides, std::string_view implied = {});

/// Reads the document; `file_name` becomes the name of the scene. Throws as parse_study.
Study read_document(const SceneDocument& document, const std::string& file_name,
                    SceneUnits units = SceneUnits::told);

}  // namespace hamjet::io
