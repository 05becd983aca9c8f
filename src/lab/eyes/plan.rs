//! What is looked at, and by which camera.

use super::moments::{Bounds, RandomMoment};
use super::readings::{OtherRobot, Readings};
use super::report::{EyesReport, numbers, range_bias};
use crate::data::{AssetFolder, AssetKind, DataError, Source};
use crate::game::{Choice, MatchPlan};
use crate::geometry::{Pose, Sighting, wrap_angle};
use crate::ids::{RobotId, Team};
use crate::rng::{Dice, Seed};
use crate::robot::{Camera, RobotKind};
use crate::vision::{CameraCalibration, ColourLookup, Gaze, KnownObjects, Recognised, Segmenter, recognise};
use crate::world::sense::picture::{Canvas, Hall, Light, Moment, Shot};
use crate::world::sense::sway::{MountError, Sway};
use crate::world::sense::{Blob, nod, robot_paint, visible_share};

/// What a person chooses.
#[derive(Clone, Debug, PartialEq)]
pub struct EyesChoice {
    /// The match whose pitch, ball, light and robots are seen, and whose home team's fast model is compared.
    pub file: Option<String>,
    /// The camera: a name among the assets or a path.
    pub camera: String,
    /// Pictures.
    pub views: u32,
    /// Of the dice.
    pub seed: u64,
}

/// Pictures that can be drawn and worked out.
#[derive(Clone, Debug)]
pub struct EyesPlan {
    choice: EyesChoice,
    plan: MatchPlan,
    calibration: CameraCalibration,
    fast: Camera,
}

impl EyesPlan {
    /// Reads everything that is needed.
    ///
    /// # Errors
    /// The first file that is missing or wrong, or home eyes without a model of a camera.
    pub fn read(assets: &AssetFolder, choice: &EyesChoice) -> Result<EyesPlan, DataError> {
        let plan = MatchPlan::read(assets, &Choice { file: choice.file.clone(), ..Choice::default() })?;
        let calibration = assets.file(AssetKind::Camera, &choice.camera);
        let calibration: CameraCalibration = Source::read(calibration)?.parse_sound()?;
        let sensing = &plan.team(Team::Home).senses.sensing;
        let Some(&fast) = sensing.eyes.camera() else {
            let message =
                format!("the home team of the match has the eyes `{}`, which no camera has", sensing.name);
            return Err(DataError::new("--match", message));
        };
        Ok(EyesPlan { choice: choice.clone(), plan, calibration, fast })
    }

    /// How many pictures there are.
    pub fn views(&self) -> u32 {
        self.choice.views
    }

    /// From corner to corner of the pitch, m.
    fn farthest(&self) -> f32 {
        2.0 * self.plan.pitch.half_size().length()
    }

    fn kind(&self, team: Team) -> &RobotKind {
        &self.plan.team(team).kind
    }

    /// Draws all pictures and works them out, or until it is to stop; says after each how many are over.
    pub fn run(&self, mut goes_on: impl FnMut(u32) -> bool) -> EyesReport {
        let mut studio = Studio::new(self);
        let mut views = 0;
        while views < self.choice.views {
            studio.look();
            views += 1;
            if !goes_on(views) {
                break;
            }
        }
        let numbers = numbers(&self.fast, &studio.readings, self.farthest());
        EyesReport::new(
            (numbers, range_bias(&studio.readings)),
            self.names(),
            (views, self.choice.seed),
            views < self.choice.views,
        )
    }

    /// Of the model and of the camera.
    fn names(&self) -> [String; 2] {
        [self.plan.team(Team::Home).senses.sensing.name.clone(), self.calibration.name.clone()]
    }
}

/// Everything that pictures are made with, and what they gave.
struct Studio<'a> {
    plan: &'a EyesPlan,
    hall: Hall,
    known: KnownObjects,
    light: Light,
    lookup: ColourLookup,
    segmenter: Segmenter,
    canvas: Canvas,
    moment: Moment,
    bounds: Bounds,
    dice: Dice,
    /// For the light and for how the camera is held.
    hall_dice: Dice,
    readings: Readings,
}

/// Light has drifted anywhere after so many seconds.
const AGES: f32 = 1e9;

/// The robot whose camera it is.
const OWN: RobotId = RobotId::new(Team::Home, 0);

impl Studio<'_> {
    fn new(plan: &EyesPlan) -> Studio<'_> {
        let game = &plan.plan;
        let kinds = Team::BOTH.map(|team| robot_paint(&game.team(team).kind));
        let players: usize = Team::BOTH.map(|team| game.team(team).strategy.players.len()).iter().sum();
        let optics = &plan.calibration.optics;
        Studio {
            plan,
            hall: Hall::of(&game.pitch, &game.ball),
            known: KnownObjects::new(&game.pitch, &game.ball, kinds),
            light: Light::new(game.light),
            lookup: ColourLookup::new(&plan.calibration.colours),
            segmenter: Segmenter::default(),
            canvas: Canvas::default(),
            moment: Moment::default(),
            bounds: Bounds {
                half: game.pitch.half_size(),
                field_of_view: optics.field_of_view.to_radians(),
                farthest: plan.farthest(),
                others: players - 1,
                room: game.team(Team::Home).kind.reach().max(game.team(Team::Away).kind.reach()),
                pan: plan.kind(OWN.team).neck.map_or(0.0, |neck| neck.pan.to_radians()),
            },
            dice: Dice::new(Seed(plan.choice.seed), "views", None),
            hall_dice: Dice::new(Seed(plan.choice.seed), "views of a hall", None),
            readings: Readings::default(),
        }
    }

    /// Draws one picture and takes note of what it gave.
    fn look(&mut self) {
        let plan = self.plan;
        let (drawn, robots) = self.place();
        let ball = Sighting::of(drawn.ball, drawn.own);
        let recognised = self.recognise(&drawn);
        let blobs: Vec<Blob> = robots.iter().map(|(id, pose)| self.blob(*id, *pose, drawn.own)).collect();
        let trailers: Vec<(RobotId, Blob)> = robots
            .iter()
            .filter_map(|(id, pose)| Some((*id, self.trailer(*id, *pose, drawn.own)?)))
            .collect();
        let view = plan.fast.field_of_view;
        let solid = || blobs.iter().copied().chain(trailers.iter().map(|(_, blob)| *blob));
        let own_ball = Blob::of(drawn.ball, plan.plan.ball.radius, drawn.own);
        let covers = (ball, own_ball.half_angle);
        self.readings.note_ball(covers, visible_share(own_ball, solid(), view), recognised.ball);
        let others: Vec<OtherRobot> = (robots.iter().zip(&blobs).enumerate())
            .map(|(index, ((id, pose), blob))| {
                let bodies = blobs.iter().enumerate().filter(|(other, _)| *other != index);
                let hitched = trailers.iter().filter(|(of, _)| of != id).map(|(_, blob)| *blob);
                let between = bodies.map(|(_, blob)| *blob).chain(hitched);
                let truth = Sighting::of(pose.position, drawn.own);
                OtherRobot { team: id.team, truth, visible: visible_share(*blob, between, view) }
            })
            .collect();
        self.readings.note_robots(&others, &recognised.robots);
    }

    /// Puts everything somewhere; the robots but for the one that looks on.
    fn place(&mut self) -> (RandomMoment, Vec<(RobotId, Pose)>) {
        let plan = self.plan;
        let drawn = RandomMoment::draw(&self.bounds, &mut self.dice);
        let robots: Vec<(RobotId, Pose)> = self.others().zip(drawn.others.iter().copied()).collect();
        self.moment.clear();
        self.moment.ball = Some(drawn.ball);
        self.moment.add(OWN, plan.kind(OWN.team), drawn.own, 0.0, Some(drawn.own));
        for &(id, pose) in &robots {
            self.moment.add(id, plan.kind(id.team), pose, 0.0, Some(pose));
        }
        (drawn, robots)
    }

    /// Takes a picture and works it out.
    fn recognise(&mut self, drawn: &RandomMoment) -> Recognised {
        let camera = &self.plan.calibration;
        let ball = Sighting::of(drawn.ball, drawn.own);
        let is_ahead = wrap_angle(ball.bearing).abs() < self.bounds.field_of_view / 2.0;
        let mount = MountError::drawn(&camera.flaws.play, &mut self.hall_dice);
        let light = self.light.drifted(AGES, &mut self.hall_dice);
        let shot = Shot {
            robot: OWN,
            from: drawn.own,
            gaze: Gaze { pan: 0.0, tilt: nod(&camera.optics, Some(ball).filter(|_| is_ahead)) },
            sway: Sway::of(&camera.flaws, drawn.stride, mount, drawn.head),
            optics: camera.optics,
            flaws: camera.flaws,
            settings: camera.settings,
            turn_rate: drawn.turn_rate,
            hides_ball: false,
        };
        self.canvas.draw(&self.hall, &self.moment, &shot, &light, &mut self.dice);
        let segmented = self.segmenter.segment(self.canvas.image(), &self.lookup);
        recognise(segmented, &camera.optics, shot.gaze, &self.known)
    }

    /// The other robots of the match.
    fn others(&self) -> impl Iterator<Item = RobotId> + use<> {
        let players = Team::BOTH.map(|team| self.plan.plan.team(team).strategy.players.len() as u8);
        let of_team =
            move |team: Team| (0..players[team.index()]).map(move |number| RobotId::new(team, number));
        Team::BOTH.into_iter().flat_map(of_team).filter(|id| *id != OWN)
    }

    fn blob(&self, id: RobotId, pose: Pose, from: Pose) -> Blob {
        Blob::of(pose.position, self.plan.kind(id.team).reach(), from)
    }

    fn trailer(&self, id: RobotId, pose: Pose, from: Pose) -> Option<Blob> {
        let (middle, radius) = self.plan.kind(id.team).trailer.as_ref()?.round();
        Some(Blob::of(pose.to_field(middle), radius, from))
    }
}
