#pragma once

#include "endowire/contact/sample.hpp"

namespace endowire::contact {

/// Puts a sample at an arc of the wire: its rod, its fraction and what the wire is there.
void put_at(const rod::MaterialLine& line, const rod::ChainMaterial& material, double arc_mm, Sample& sample);

}  // namespace endowire::contact
