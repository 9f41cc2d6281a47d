#pragma once
// The physics of billiard balls: impacts between balls and with cushions, and the friction of the cloth from sliding to
// rolling. Metres, seconds, kilograms. Origin: the middle of the cloth; y up; a ball's centre stays at y = radius.
// Sources: Marlow, The Physics of Pocket Billiards, 1995; Hunt and Crossley, Coefficient of Restitution Interpreted as
// Damping in Vibroimpact, J. Applied Mechanics 42, 1975. Balls do not leave the cloth.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace aleph {

struct PoolSettings {
    double length = 2.54, width = 1.27;  ///< m between the cushions, along x and z
    double radius = 0.028575;            ///< m
    double mass = 0.17;                  ///< kg
    double gravity = 9.81;               ///< m/s2
    double sliding_friction = 0.2;       ///< ball on cloth, no unit
    double rolling_friction = 0.01;      ///< deceleration of a rolling ball over gravity
    double spin_deceleration = 10.0;     ///< rad/s2, of the spin about y
    double ball_restitution = 0.95;
    double ball_friction = 0.06;  ///< ball on ball
    double cushion_restitution = 0.82;
    double cushion_friction = 0.14;
    double contact_stiffness = 5.2e8;  ///< N/m^1.5, Hertz: phenolic resin, 5.8 GPa, Poisson ratio .34
    double touching_gap = 5e-4;        ///< m; compression in a hard impact: balls nearer than this share it
    double soft_speed = 1e-4;          ///< m/s; slower impacts do not bounce, so that contacts end
    double step = 1.0 / 9600.0;        ///< s, between changes of velocity by friction
};

struct PoolBall {
    glm::dvec3 position{0.0};          ///< m, of the centre
    glm::dvec3 velocity{0.0};          ///< m/s, horizontal
    glm::dvec3 angular_velocity{0.0};  ///< rad/s
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};

/// Velocity of the contact point relative to the cloth, m/s; 0 for a rolling ball.
glm::dvec3 cloth_slip(const PoolBall& ball, const PoolSettings& settings);

/// Simultaneous impact of balls that touch (nearer than `touching_gap`): usually a pair, in the rack more. Friction can
/// spin them about any axis; the cloth takes the vertical part of the impulse, so that horizontal momentum is conserved
/// and energy is not gained.
/// @param members  indices of the balls
void collide_balls(std::vector<PoolBall>& balls, const std::vector<int>& members, const PoolSettings& settings);

/// @param normal  unit, horizontal, from the cushion into the table
void collide_cushion(PoolBall& ball, const glm::dvec3& normal, const PoolSettings& settings);

/// Friction of the cloth during a time: sliding friction until the ball rolls, then rolling friction; spin about y
/// decreases.
void apply_cloth_friction(PoolBall& ball, double seconds, const PoolSettings& settings);

}  // namespace aleph
