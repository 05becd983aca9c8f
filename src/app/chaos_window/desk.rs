//! What ChaosManager's window shows, and what a person does there: the camera's panel, what the robot says of itself, levers to
//! drive it. It knows nothing of sockets.

use std::sync::Arc;

use bevy_egui::egui::{self, RichText};

use super::robot::RobotElsewhere;
use crate::app::inspector::sections::TeleoperatedBody;
use crate::app::inspector::set_close;
use crate::app::inspector::table;
use crate::app::inspector::vision::files;
use crate::app::inspector::vision::{CalibrationPage, CalibrationView, CalibrationWidget, CalibrationWish};
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::input::manual_control::{ControlInput, ManualControl};
use crate::app::view::state::FreeArea;
use crate::app::view::{colours, format, style};
use crate::clock::Clock;
use crate::data::{AssetFolder, AssetKind, Source};
use crate::game::MatchPlan;
use crate::game::net::chaos::{DebugData, LinkFigures, StrategyText};
use crate::ids::{RobotId, Team};
use crate::robot::RobotKind;
use crate::robot::pilot::Pilot;
use crate::vision::{CameraCalibration, KnownObjects};
use crate::world::sense::robot_paint;

/// What is known of the match beforehand, from its files.
#[derive(Clone, Debug)]
pub struct KnownMatch {
    /// What the robot is built as.
    pub kind: Arc<RobotKind>,
    /// What can be recognised in its pictures.
    pub known: KnownObjects,
}

impl KnownMatch {
    /// What a robot of a match is, and what it may see.
    pub fn of(plan: &MatchPlan, robot: RobotId) -> KnownMatch {
        let paints = Team::BOTH.map(|team| robot_paint(&plan.team(team).kind));
        KnownMatch {
            kind: plan.team(robot.team).kind.clone(),
            known: KnownObjects::new(&plan.pitch, &plan.ball, paints),
        }
    }
}

/// The window's contents.
pub struct ChaosDesk {
    pub robot: RobotElsewhere,
    pub assets: AssetFolder,
    /// Nothing is recognised and no kicks are known without it.
    pub game: Option<KnownMatch>,
    widget: CalibrationWidget,
    /// The file that the calibration was saved to or loaded from.
    file: Option<(String, CameraCalibration)>,
    /// Whether a person drives the robot from here.
    drives: bool,
    control: ManualControl,
    /// Counts sixtieths of a second, for how long a kick is asked for.
    clock: Clock,
    keyboard: Keyboard,
}

/// Width of what the robot says of itself, in points.
const ASIDE: f32 = 330.0;

impl ChaosDesk {
    pub fn new(robot: RobotElsewhere, assets: AssetFolder, game: Option<KnownMatch>) -> ChaosDesk {
        ChaosDesk {
            robot,
            assets,
            game,
            widget: CalibrationWidget::default(),
            file: None,
            drives: false,
            control: ManualControl::default(),
            clock: Clock::new(60.0),
            keyboard: Keyboard::default(),
        }
    }

    /// The controls, while a person drives the robot from here.
    pub fn pilot(&self) -> Option<Pilot> {
        self.drives.then(|| self.control.with(ControlInput::default()))
    }

    /// Shows everything; `seconds` have passed since the window opened, and `silence` says since when nothing is heard, if that is
    /// long.
    pub fn show(
        &mut self,
        ctx: &egui::Context,
        (figures, silence, seconds): (&LinkFigures, Option<&str>, f64),
    ) {
        self.clock.tick = (seconds / f64::from(self.clock.dt)) as u64;
        self.control.let_kick_pass(&self.clock);
        let mut area = FreeArea(ctx.content_rect());
        let frame = style::panel_frame(colours::PANEL, egui::Margin::symmetric(10, 7));
        let bottom = egui::Panel::bottom("figures").resizable(false).frame(frame);
        area.dock(ctx, "figures", bottom, |ui| show_figures(ui, figures, silence));
        let right = egui::Panel::right("robot").resizable(false).exact_size(ASIDE).frame(frame);
        area.dock(ctx, "robot", right, |ui| {
            set_close(ui);
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| self.show_robot(ui));
        });
        let left = egui::Panel::left("camera").resizable(false).exact_size(area.0.width()).frame(frame);
        area.dock(ctx, "camera", left, |ui| {
            set_close(ui);
            self.show_camera(ui);
        });
    }

    fn show_camera(&mut self, ui: &mut egui::Ui) {
        let Some(calibration) = self.robot.calibration() else {
            let id = self.robot.id;
            ui.weak(match self.robot.is_blind {
                true => format!("{id} sees without pictures."),
                false => format!("{id} has not said how its camera is calibrated."),
            });
            return;
        };
        let picture = self.robot.picture.as_ref();
        let view = CalibrationView {
            whose: self.robot.id.to_string(),
            image: picture.map(|(image, _)| image),
            truth: None,
            quality: self.robot.debug.as_ref().and_then(|data| data.quality.as_ref()),
            gaze: picture.map(|(_, gaze)| *gaze).unwrap_or_default(),
            known: self.game.as_ref().map(|game| &game.known),
            calibration: &calibration,
            file: self.file.as_ref().map(|(name, file)| (name.as_str(), file)),
            light: None,
        };
        let assets = &self.assets;
        let names = || assets.names(AssetKind::Camera);
        let mut page = CalibrationPage::new(&mut self.widget, view, &names);
        ui.horizontal_wrapped(|ui| page.show_toolbar(ui));
        ui.separator();
        page.show(ui);
        for wish in page.finish() {
            self.carry_out(wish, &calibration);
        }
    }

    fn carry_out(&mut self, wish: CalibrationWish, calibration: &CameraCalibration) {
        let told = match wish {
            CalibrationWish::Camera(settings) => return self.robot.set_camera(settings),
            CalibrationWish::Colours(colours) => return self.robot.set_colours(colours),
            CalibrationWish::Light(_) => return,
            CalibrationWish::Save(name) => files::save(&self.assets, &name, calibration).map(|path| {
                self.file = Some((name, calibration.clone()));
                format!("Saved {}", path.display())
            }),
            CalibrationWish::Load(name) => files::load(&self.assets, &name).map(|file| {
                self.robot.set_camera(file.settings);
                self.robot.set_colours(file.colours.clone());
                let told = format!("{} is sent {name}", self.robot.id);
                self.file = Some((name, file));
                told
            }),
        };
        self.widget.panel.told = Some(match told {
            Ok(words) => (true, words),
            Err(error) => (false, error),
        });
    }

    fn show_robot(&mut self, ui: &mut egui::Ui) {
        let id = self.robot.id;
        let title = RichText::new(format!("ChaosManager: {id}")).size(15.0).strong();
        ui.label(title.color(colours::egui(colours::team_text(id.team))));
        if let Some((well, words)) = &self.robot.told {
            let colour = if *well { colours::GOOD } else { colours::PENALTY };
            ui.colored_label(colours::egui(colour), words);
        }
        ui.separator();
        match &self.robot.debug {
            Some(data) => show_state(ui, data),
            None => {
                ui.weak("It has said nothing of itself yet.");
            }
        }
        ui.separator();
        self.show_strategies(ui);
        ui.separator();
        self.show_levers(ui);
    }

    fn show_strategies(&mut self, ui: &mut egui::Ui) {
        let team = self.robot.id.team;
        let menu = ui.menu_button("Send a strategy", |ui| {
            egui::ScrollArea::vertical().show(ui, |ui| {
                for name in self.assets.names(AssetKind::Strategy) {
                    if ui.button(&name).clicked() {
                        ui.close();
                        let path = self.assets.file(AssetKind::Strategy, &name);
                        match Source::read(&path) {
                            Ok(Source { text, .. }) => {
                                self.robot.play(StrategyText { name: format!("{name}.ron"), text });
                            }
                            Err(error) => self.robot.told = Some((false, error.to_string())),
                        }
                    }
                }
            });
        });
        menu.response.on_hover_text(format!("The {team} team plays on with a file from here"));
    }

    fn show_levers(&mut self, ui: &mut egui::Ui) {
        let (words, tip) = if self.drives {
            ("Hand back", "Let the strategy drive it again")
        } else {
            ("Take over", "Drive this robot from here; it stops when nothing is heard from here")
        };
        if ui.button(words).on_hover_text(tip).clicked() {
            self.drives = !self.drives;
            self.control = ManualControl::default();
        }
        let Some(game) = &self.game else {
            ui.weak("How it walks and kicks is known with --match.");
            return;
        };
        let pan = self.robot.picture.as_ref().map_or(0.0, |(_, gaze)| gaze.pan);
        // Whether it holds the ball it does not say, so no kick is ruled out here.
        let body =
            TeleoperatedBody { kind: &game.kind, pan, chin: "not known here", holds: true, kicking: None };
        let (control, keyboard, clock) = (&mut self.control, &self.keyboard, &self.clock);
        ui.add_enabled_ui(self.drives, |ui| body.show_levers(ui, control, keyboard, clock));
    }
}

/// What the robot says of itself.
fn show_state(ui: &mut egui::Ui, data: &DebugData) {
    table::line(ui, "role", data.role.as_str());
    if data.acting_as != data.role {
        table::line(ui, "acts as", data.acting_as.as_str());
    }
    table::line(ui, "state", data.states.join(" › "));
    let [x, y] = format::coordinates(data.pose.position);
    let lost = if data.is_localised { "" } else { ", but is lost" };
    table::line(ui, "believes", format!("to be at {x}, {y} m, {}{lost}", format::degrees(data.pose.heading)));
    let ball = data.ball.map_or("nowhere".to_owned(), |ball| {
        let [x, y] = format::coordinates(ball.position);
        let (speed, age) = (format::speed(ball.velocity.length()), format::seconds(ball.age));
        format!("at {x}, {y} m, {speed}, seen {age} ago")
    });
    table::line(ui, "ball", ball);
    table::line(ui, "driven", if data.is_driven { "by a person" } else { "by its strategy" });
}

/// What came over and what did not, in a line.
fn show_figures(ui: &mut egui::Ui, figures: &LinkFigures, silence: Option<&str>) {
    ui.horizontal_wrapped(|ui| {
        if let Some(silence) = silence {
            ui.colored_label(colours::egui(colours::PENALTY), silence);
            ui.separator();
        }
        let LinkFigures { images, data, orders, expired, .. } = figures;
        ui.label(format!("Pictures: {} whole, {} missing", images.received, images.missing));
        ui.separator();
        ui.label(format!("Data: {}, {} missing", data.received, data.missing));
        ui.separator();
        ui.label(format!("Orders: {orders}"));
        ui.separator();
        ui.label(format!("Messages of which parts are missing: {expired}"));
    });
}
