#pragma once
#include <suture/interface/ContactBodies.hpp>

namespace suture {

/// Energy norm of a body that carries nothing, relative to the largest that it has had.
constexpr double kNegligibleEnergyNorm = 1e-12;

/// Imbalance of the loads and pair forces on a body, in the motions that nothing but contact stops, beside the forces that pass through it:
/// the largest of all bodies. Forces across these motions count, too, by what deforms the body, and a body without loads has a share of its
/// neighbours': what is left along a motion that nothing drives is rounding of them. Local; the same on all ranks.
/// \param force    of each pair
/// \param energy   U.S U of each part, twice its deformation energy
/// \param largest  the largest that it has had in the run; sets what counts as rounding
double bodyImbalance(const ContactBodies& bodies, const Vector& force, const Vector& energy, const Vector& largest);

}  // namespace suture
