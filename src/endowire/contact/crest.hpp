#pragma once

#include "endowire/contact/contact_spec.hpp"
#include "endowire/contact/sample.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::contact {

/// Puts a sample at an arc of the wire: its rod, its fraction and what the wire is there.
void put_at(const rod::MaterialLine& line, const rod::ChainMaterial& material, double arc_mm, Sample& sample);

/// Moves a sample to where its stretch of wire is nearest to the wall, a crest of the wall as the wire sees it; to its nominal
/// place when the wall does not bulge towards the wire there, or is out of reach.
///
///   φ'(s*) = 0,  φ' rising,  s* in [from, to];   n = (φ'₋ ∇φ₊ − φ'₊ ∇φ₋)/(φ'₋ − φ'₊)
///
/// A straight wire over an edge of the wall touches it at one point, which slides along the wire as the wire moves. By the
/// envelope theorem the least distance has the slope of the distance at that point, and none along the wire; n is the
/// one of the normals on both sides of the edge that is square to the wire: the contact of a line with an edge. Samples that
/// stayed on their places would fall off the edge sideways, from one minimum of energy to the next.
/// Symbols  φ' slope of the wall distance along the wire, ∇φ± gradients on the two sides of the crest              [-]
void seek_crest(const Wire& wire, const vessel::Field& field, const ContactSpec& spec, Sample& sample);

}  // namespace endowire::contact
