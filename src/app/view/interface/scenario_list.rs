//! The scenarios among the assets, to choose one from on the menu's third card.

use std::path::PathBuf;

use bevy::prelude::*;
use bevy_egui::egui;
use egui::{RichText, vec2};

use crate::app::match_request::MatchRequest;
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::style;
use crate::app::view::style::SMALL;
use crate::data::{AssetFolder, AssetKind, Source};
use crate::lab::scenario::{ScenarioFile, ScenarioRef};

/// The list, and what is chosen of it.
#[derive(Resource, Clone, Debug, Default)]
pub struct ScenarioList {
    entries: Vec<ScenarioEntry>,
    /// Index into `entries`.
    chosen: Option<usize>,
}

#[derive(Clone, Debug, PartialEq)]
struct ScenarioEntry {
    scenario: ScenarioRef,
    /// Name and source, or what is wrong with the file.
    found: Result<[String; 2], String>,
}

impl ScenarioList {
    /// Reads what there is to choose from.
    pub fn refresh(&mut self, assets: &AssetFolder) {
        let chosen =
            self.chosen.and_then(|index| self.entries.get(index)).map(|entry| entry.scenario.clone());
        let paths =
            assets.names(AssetKind::Scenario).into_iter().map(|name| assets.file(AssetKind::Scenario, &name));
        self.entries = paths.flat_map(ScenarioEntry::read).collect();
        let place = |entry: &ScenarioEntry| Some(&entry.scenario) == chosen.as_ref();
        self.chosen = self.entries.iter().position(place).or(Some(0).filter(|_| !self.entries.is_empty()));
    }

    /// Shows the list with a button; the scenario to play when that is asked for.
    pub fn show(&mut self, ui: &mut egui::Ui) -> Option<MatchRequest> {
        if self.entries.is_empty() {
            ui.label("There are no scenarios among the assets.");
            return None;
        }
        let mut asked = false;
        let room = (ui.available_height() - 46.0).max(20.0);
        egui::ScrollArea::vertical().max_height(room).auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 3.0;
            for (index, entry) in self.entries.iter().enumerate() {
                let row = show_entry(ui, entry, self.chosen == Some(index));
                if row.clicked() || row.double_clicked() {
                    self.chosen = Some(index);
                }
                asked |= row.double_clicked();
            }
        });
        let foot = egui::Layout::bottom_up(egui::Align::Min);
        let button = |ui: &mut egui::Ui| style::big_button(ui, "Play").clicked();
        asked |= ui.with_layout(foot, button).inner;
        let entry = self.chosen.and_then(|index| self.entries.get(index)).filter(|_| asked)?;
        Some(MatchRequest::Scenario { scenario: entry.scenario.clone(), seed: None })
    }
}

impl ScenarioEntry {
    /// An entry for each variant in a file.
    fn read(path: PathBuf) -> Vec<ScenarioEntry> {
        let file = match Source::read(&path).and_then(|source| source.parse::<ScenarioFile>()) {
            Ok(file) => file,
            Err(error) => {
                return vec![ScenarioEntry { scenario: path.into(), found: Err(error.to_string()) }];
            }
        };
        let scenarios = file.scenarios().into_iter().map(|(variant, file)| {
            let scenario = ScenarioRef { path: path.clone(), variant: variant.map(str::to_owned) };
            let found = [file.name, file.source].map(Option::unwrap_or_default);
            ScenarioEntry { scenario, found: Ok(found) }
        });
        scenarios.collect()
    }
}

/// A row of two wrapped texts on one ground that can be clicked.
fn show_entry(ui: &mut egui::Ui, entry: &ScenarioEntry, is_chosen: bool) -> egui::Response {
    let (name, second, colour) = match &entry.found {
        Ok([name, source]) => (name.as_str(), source.as_str(), colours::QUIET),
        Err(fault) => ("A file with a fault", fault.as_str(), colours::PENALTY),
    };
    let width = (ui.available_width() - 10.0).max(30.0);
    let text = |text: &str, size: f32, colour| {
        let text = RichText::new(text).size(size).color(paint(colour));
        egui::WidgetText::from(text)
    };
    let wrap = Some(egui::TextWrapMode::Wrap);
    let body = egui::TextStyle::Body;
    let name = text(name, 14.0, colours::TEXT).into_galley(ui, wrap, width - 16.0, body.clone());
    let second = text(second, SMALL, colour).into_galley(ui, wrap, width - 16.0, body);
    let size = vec2(width, name.size().y + second.size().y + 8.0);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click());
    if ui.is_rect_visible(rect) {
        let ground = match (is_chosen, response.hovered()) {
            (true, _) => paint(colours::ACCENT).gamma_multiply(0.45),
            (false, true) => paint(colours::RAISED).gamma_multiply(1.4),
            (false, false) => paint(colours::RAISED),
        };
        let painter = ui.painter();
        painter.rect_filled(rect, 4.0, ground);
        let at = rect.min + vec2(8.0, 4.0);
        let below = at + vec2(0.0, name.size().y);
        painter.galley(at, name, paint(colours::TEXT));
        painter.galley(below, second, paint(colour));
    }
    response.on_hover_text("Click to choose, double-click to play")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_has_every_scenario_with_its_name_and_source() {
        let mut list = ScenarioList::default();
        list.refresh(&AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets")));
        let figure_8 = list.entries.iter().find(|entry| entry.scenario.path.ends_with("swap_figure_8.ron"));
        let [name, source] = figure_8.unwrap().found.clone().unwrap();
        assert!(!name.is_empty() && source.contains("figure 8"), "{name} {source}");
        assert_eq!(list.chosen, Some(0));
    }

    #[test]
    fn without_files_there_is_nothing_to_choose() {
        let mut list = ScenarioList::default();
        list.refresh(&AssetFolder::new("/no/such/folder"));
        assert_eq!((list.entries.len(), list.chosen), (0, None));
    }
}
