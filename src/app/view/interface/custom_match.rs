//! The form for a custom match: who plays, which robot a person drives, how long, and from which seed.

use bevy::prelude::*;
use bevy_egui::egui;

use crate::app::view::{colours, format, style};
use crate::data::{AssetFolder, AssetKind};
use crate::game::Choice;
use crate::ids::{RobotId, Team};
use crate::strategy::Strategy;

/// What the form says now.
#[derive(Resource, Clone, Debug)]
pub struct CustomMatch {
    /// The strategies among the assets.
    offers: Vec<Offer>,
    /// Indices into `offers`, home first.
    teams: [usize; 2],
    pilot: Option<RobotId>,
    half_minutes: f32,
    seed: u64,
}

/// A strategy among the assets.
#[derive(Clone, Debug)]
struct Offer {
    file: String,
    /// What it calls itself and how many robots it has, or what is wrong with it.
    found: Result<(String, usize), String>,
}

impl Offer {
    fn title(&self) -> &str {
        self.found.as_ref().map_or(self.file.as_str(), |(name, _)| name.as_str())
    }
}

impl Default for CustomMatch {
    fn default() -> CustomMatch {
        CustomMatch { offers: Vec::new(), teams: [0, 0], pilot: None, half_minutes: 5.0, seed: 1 }
    }
}

impl CustomMatch {
    /// Reads what there is to choose from.
    pub fn refresh(&mut self, assets: &AssetFolder) {
        let chosen = self.teams.map(|team| self.offers.get(team).map(|offer| offer.file.clone()));
        self.offers = (assets.names(AssetKind::Strategy).into_iter())
            .map(|file| {
                let path = assets.file(AssetKind::Strategy, &file);
                let read = Strategy::read(assets, &path, None);
                let found = read.strategy.map(|strategy| (strategy.name, strategy.players.len()));
                Offer { file, found: found.map_err(|error| error.to_string()) }
            })
            .collect();
        for (team, chosen) in chosen.into_iter().enumerate() {
            let place = self.offers.iter().position(|offer| Some(&offer.file) == chosen.as_ref());
            self.teams[team] =
                place.unwrap_or(if team == 0 { self.offers.len().saturating_sub(1) } else { 0 });
        }
    }

    /// The match that the form describes.
    fn choice(&self) -> Choice {
        let [home, away] = self.teams.map(|team| self.offers.get(team).map(|offer| offer.file.clone()));
        let (half_minutes, seed) = (Some(self.half_minutes), self.seed);
        Choice { home, away, half_minutes, seed, pilot: self.pilot, ..Choice::default() }
    }

    /// The robots that there are to drive.
    fn seats(&self) -> impl Iterator<Item = RobotId> + '_ {
        Team::BOTH.into_iter().flat_map(|team| {
            let offer = self.offers.get(self.teams[team.index()]);
            let players =
                offer.and_then(|offer| offer.found.as_ref().ok()).map_or(0, |(_, players)| *players);
            (0..players).map(move |number| RobotId::new(team, number as u8))
        })
    }

    /// Shows the form; the match to begin when that is asked for.
    pub fn show(&mut self, ui: &mut egui::Ui) -> Option<Choice> {
        let width = (ui.available_width() - 76.0).max(40.0);
        egui::Grid::new("custom match").num_columns(2).spacing([10.0, 12.0]).show(ui, |ui| {
            for (team, name) in ["Home", "Away"].into_iter().enumerate() {
                ui.label(name);
                let offers = &self.offers;
                let title = |index: usize| offers.get(index).map_or("none", Offer::title);
                egui::ComboBox::from_id_salt(name).width(width).truncate().show_index(
                    ui,
                    &mut self.teams[team],
                    offers.len(),
                    title,
                );
                ui.end_row();
            }
            ui.label("You drive");
            self.show_seats(ui, width);
            ui.end_row();
            ui.label("A half");
            let minutes =
                egui::DragValue::new(&mut self.half_minutes).range(0.5..=45.0).speed(0.1).suffix(" minutes");
            ui.add(minutes).on_hover_text("Drag, or click and type");
            ui.end_row();
            ui.label("Seed");
            ui.horizontal(|ui| {
                let seed = egui::DragValue::new(&mut self.seed).speed(1.0);
                ui.add(seed).on_hover_text("Equal seeds give equal matches, as long as nobody drives");
                if ui.button("Another").on_hover_text("Any other seed").clicked() {
                    self.seed = fresh_seed();
                }
            });
            ui.end_row();
        });
        self.show_start(ui)
    }

    fn show_seats(&mut self, ui: &mut egui::Ui, width: f32) {
        let seats: Vec<RobotId> = self.seats().collect();
        self.pilot = self.pilot.filter(|seat| seats.contains(seat));
        let name = |seat: Option<RobotId>| seat.map_or_else(|| "nobody".into(), format::capitalised);
        egui::ComboBox::from_id_salt("seat")
            .width(width)
            .height(320.0)
            .selected_text(name(self.pilot))
            .show_ui(ui, |ui| {
                for seat in std::iter::once(None).chain(seats.into_iter().map(Some)) {
                    ui.selectable_value(&mut self.pilot, seat, name(seat));
                }
            });
    }

    fn show_start(&self, ui: &mut egui::Ui) -> Option<Choice> {
        let faults = self.teams.map(|team| self.offers.get(team)?.found.as_ref().err());
        let fault = faults.into_iter().flatten().next();
        if let Some(fault) = fault {
            let colour = colours::egui(colours::PENALTY);
            ui.add(egui::Label::new(egui::RichText::new(fault).color(colour)).wrap());
        }
        let able = fault.is_none() && !self.offers.is_empty();
        let foot = egui::Layout::bottom_up(egui::Align::Min);
        let start = |ui: &mut egui::Ui| style::big_button(ui, "Start").clicked();
        let clicked = ui.with_layout(foot, |ui| ui.add_enabled_ui(able, start).inner).inner;
        clicked.then(|| self.choice())
    }
}

/// A seed that differs from click to click, short enough to be noted down.
pub fn fresh_seed() -> u64 {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    2 + since.map_or(0, |since| since.as_millis() as u64) % 9998
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form() -> CustomMatch {
        let mut form = CustomMatch::default();
        form.refresh(&AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets")));
        form
    }

    #[test]
    fn the_form_offers_every_strategy_and_every_seat() {
        let form = form();
        assert!(form.offers.len() >= 2 && form.offers.iter().all(|offer| offer.found.is_ok()));
        assert_eq!(form.seats().count(), 8);
        assert!(form.choice().home.is_some() && form.choice().home != form.choice().away);
    }

    #[test]
    fn a_choice_outlives_a_look_at_the_files() {
        let mut form = form();
        form.teams = [0, 0];
        form.refresh(&AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets")));
        assert_eq!(form.teams, [0, 0]);
    }

    #[test]
    fn without_files_there_is_nothing_to_play_and_nobody_to_drive() {
        let mut form = CustomMatch::default();
        form.refresh(&AssetFolder::new("/no/such/folder"));
        assert_eq!((form.seats().count(), form.choice().home), (0, None));
    }
}
