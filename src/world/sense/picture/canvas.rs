//! Where a picture is made.

use super::ball::Sphere;
use super::film::{Exposure, Film};
use super::glass::Glass;
use super::hall::Hall;
use super::light::Light;
use super::material::Material;
use super::moment::Moment;
use super::raster::Raster;
use super::shot::{Shot, Viewpoint};
use super::solid::Spread;
use super::warp::Warp;
use crate::rng::Dice;
use crate::vision::{ColourClass, Image};

/// A picture with all that is needed to make the next one. Used again and again, it takes no memory for a picture.
#[derive(Clone, Debug, Default)]
pub struct Canvas {
    image: Image,
    raster: Raster,
    warp: Warp,
    glass: Glass,
    film: Film,
    sphere: Sphere,
}

impl Canvas {
    /// Draws what a camera sees.
    pub fn draw(&mut self, hall: &Hall, moment: &Moment, shot: &Shot, light: &Light, dice: &mut Dice) {
        self.paint(hall, moment, shot, light.mean.unevenness);
        self.warp.apply(shot, self.raster.tones());
        self.glass.fit(shot.size());
        let (light, amplification) = (light.rgb(), shot.amplification());
        let exposure = Exposure {
            light: [0, 1, 2].map(|channel| light[channel] * amplification[channel]),
            gain: shot.settings.gain,
            smear: shot.smear(),
        };
        self.film.develop((self.warp.tones(), shot.size()), &self.glass, &exposure, dice, &mut self.image);
    }

    /// Paints what each pixel would show through a lens that does not bend, held as it is.
    fn paint(&mut self, hall: &Hall, moment: &Moment, shot: &Shot, unevenness: f32) {
        let view = Viewpoint::of(shot);
        let light = Spread { evenness: &hall.evenness, unevenness };
        let ball = moment.ball.filter(|_| !shot.hides_ball);
        let raster = &mut self.raster;
        raster.begin(view.size);
        hall.floor.paint(&view, &light, raster);
        moment.cast(&view, shot.robot, ball.map(|at| (at, hall.ball_radius)), raster);
        hall.solids.paint(&view, &light, shot.robot, raster);
        moment.solids.paint(&view, &light, shot.robot, raster);
        if let Some(at) = ball {
            let middle = view.corner(at, hall.ball_radius, light.shade(at, 1.0));
            self.sphere.paint(&view, middle, hall.ball_radius, Material::of(ColourClass::Orange), raster);
        }
    }

    /// The last picture.
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// What each pixel of the last picture truly shows, if it is of a class: row by row, before a turn smears it.
    pub fn truth(&self) -> impl Iterator<Item = Option<ColourClass>> + '_ {
        self.warp.tones().iter().map(|tone| tone.material().class())
    }
}
