//! Pictures of the camera of a robot, drawn of the truth. Pure, without a graphics card.
//!
//! A [`Canvas`] draws one [`Shot`] of a [`Hall`] at a [`Moment`] in some [`Light`]. Each pixel is first what it shows and how
//! bright that is (`raster`): the floor row by row from a picture of it from above, then convex polygons and the ball, the nearest
//! first. That is moved to where the sensor has it (`warp`): a lens bends, a body sways, rows are read one after the other. The sensor
//! (`film`) then makes brightness and colours of it, with noise, through the lens (`glass`). What each pixel shows is also the
//! [truth](Canvas::truth) that segmentation is measured against.

mod ball;
mod canvas;
mod evenness;
mod film;
mod floor;
mod glass;
mod hall;
mod light;
mod material;
mod moment;
mod raster;
mod shot;
mod solid;
#[cfg(test)]
mod tests;
mod warp;

pub use canvas::Canvas;
pub use hall::Hall;
pub use light::{Light, LightDrift, Lighting};
pub use moment::{Moment, robot_paint};
pub use shot::Shot;
