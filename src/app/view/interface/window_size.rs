//! The window's size: it fits the screen, and in a small window everything is drawn smaller, so that there is room for it.

use bevy::prelude::*;
use bevy::window::{Monitor, OnMonitor, PrimaryMonitor, PrimaryWindow};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(PreUpdate, (fit_into_screen, keep_readable).chain());
}

/// The window's size at first, in points.
pub const FIRST: UVec2 = UVec2::new(1280, 720);
/// The room that the interface needs, in points.
pub const NEEDED: Vec2 = Vec2::new(640.0, 400.0);
/// Room for the window's title and the desktop's own bars, in points.
const BARS: f32 = 40.0;

/// The pixels of a window of a wanted size, on a screen.
fn fitting(wanted: UVec2, screen: UVec2, pixels_a_point: f32) -> UVec2 {
    let bars = (BARS * pixels_a_point).round() as u32;
    let free = UVec2::new(screen.x, screen.y.saturating_sub(bars)).max(UVec2::ONE);
    if wanted.cmple(screen).all() { wanted } else { wanted.min(free) }
}

/// Pixels a point in a window of this many pixels, on a screen that has `of_screen`: fewer if the interface had no room otherwise,
/// but not less than one.
pub fn pixels_a_point(window: UVec2, of_screen: f32) -> f32 {
    let fits = (window.as_vec2() / NEEDED).min_element();
    fits.min(of_screen).max(of_screen.min(1.0))
}

/// Once, when the window has opened.
fn fit_into_screen(
    mut window: Single<(&mut Window, Option<&OnMonitor>), With<PrimaryWindow>>,
    screens: Query<(Entity, &Monitor, Has<PrimaryMonitor>)>,
    mut done: Local<bool>,
) {
    if *done || screens.is_empty() {
        return;
    }
    *done = true;
    let (window, on) = &mut *window;
    let own = on.and_then(|on| screens.get(on.0).ok());
    let first = || screens.iter().max_by_key(|(_, _, is_primary)| *is_primary);
    let Some((_, screen, _)) = own.or_else(first) else { return };
    let (wanted, size) = (window.resolution.physical_size(), screen.physical_size());
    let fits = fitting(wanted, size, window.resolution.base_scale_factor());
    if fits != wanted {
        window.resolution.set_physical_resolution(fits.x, fits.y);
    }
}

fn keep_readable(mut window: Single<&mut Window, With<PrimaryWindow>>) {
    let of_screen = window.resolution.base_scale_factor();
    let fits = pixels_a_point(window.resolution.physical_size(), of_screen);
    let wanted = Some(fits).filter(|fits| *fits < of_screen);
    if window.resolution.scale_factor_override() != wanted {
        window.resolution.set_scale_factor_override(wanted);
    }
}

#[cfg(test)]
mod tests {
    use bevy::window::WindowResolution;
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_window_of_large_points_fits_the_screen() {
        let screen = UVec2::new(1600, 1000);
        for scale in [1.0, 1.25, 2.0, 3.0] {
            let wanted = (FIRST.as_vec2() * scale).as_uvec2();
            let fits = fitting(wanted, screen, scale);
            assert!(fits.cmple(screen).all(), "{fits} at {scale}");
            assert_eq!(fits == wanted, scale < 1.3, "{fits} at {scale}");
        }
    }

    /// The window's own systems on a screen, without a screen.
    fn opened(screen: UVec2, scale: f32) -> WindowResolution {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, plugin));
        let mut resolution = WindowResolution::new(FIRST.x, FIRST.y);
        resolution.set_scale_factor_and_apply_to_physical_size(scale);
        let window = app.world_mut().spawn((Window { resolution, ..default() }, PrimaryWindow)).id();
        app.world_mut().spawn((
            Monitor {
                name: None,
                physical_height: screen.y,
                physical_width: screen.x,
                physical_position: IVec2::ZERO,
                refresh_rate_millihertz: None,
                scale_factor: f64::from(scale),
                video_modes: Vec::new(),
            },
            PrimaryMonitor,
        ));
        app.update();
        app.world().get::<Window>(window).expect("the window").resolution.clone()
    }

    #[test]
    fn on_a_screen_of_large_points_the_window_opens_within_the_screen_and_with_room() {
        for scale in [1.0, 2.0, 3.0] {
            let screen = UVec2::new(1600, 1000);
            let resolution = opened(screen, scale);
            assert!(resolution.physical_size().cmple(screen).all(), "{resolution:?}");
            assert!(resolution.size().cmpge(NEEDED - 0.5).all(), "{resolution:?}");
        }
    }

    proptest! {
        #[test]
        fn there_is_room_wherever_there_are_pixels_for_it(
            (width, height) in (640u32..4000, 400u32..3000), scale in 1.0f32..3.0,
        ) {
            let window = UVec2::new(width, height);
            let shown = pixels_a_point(window, scale);
            prop_assert!((1.0..=scale).contains(&shown));
            prop_assert!((window.as_vec2() / shown + 0.1).cmpge(NEEDED).all());
        }

        #[test]
        fn any_window_has_a_scale((width, height) in (0u32..5000, 0u32..5000), scale in 0.5f32..4.0) {
            let shown = pixels_a_point(UVec2::new(width, height), scale);
            prop_assert!(shown >= scale.min(1.0) && shown <= scale);
        }
    }
}
