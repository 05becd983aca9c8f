//! What each entity of the world is called: robots by team and number, messages by what they say and to whom, walls by where they
//! stand. What has no name of its own is called by its components.

use bevy::ecs::resource::IsResource;
use bevy::prelude::*;

use crate::app::view::format;
use crate::app::view::picture::visuals::BodyVisual;
use crate::comms::radio::InFlight;
use crate::ids::{MatchEntity, RobotId};
use crate::robot::Trailer;
use crate::world::ball::Ball;

/// An entity with its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedEntity {
    pub name: String,
    pub entity: Entity,
    /// Whether it belongs to the match, and not to the window.
    pub of_match: bool,
}

/// All entities but the resources, which Bevy keeps as entities too, and parts of others: those of the match first, by name.
pub fn named_entities(world: &mut World) -> Vec<NamedEntity> {
    let mut all = world.query_filtered::<Entity, (Without<IsResource>, Without<ChildOf>)>();
    let found: Vec<Entity> = all.iter(world).collect();
    let mut named: Vec<NamedEntity> = found
        .into_iter()
        .map(|entity| NamedEntity {
            name: name_of(world, entity),
            entity,
            of_match: world.get::<MatchEntity>(entity).is_some(),
        })
        .collect();
    named.sort_by(|a, b| (!a.of_match, &a.name, a.entity).cmp(&(!b.of_match, &b.name, b.entity)));
    named
}

/// What an entity is called.
pub fn name_of(world: &World, entity: Entity) -> String {
    let Ok(known) = world.get_entity(entity) else { return format!("{entity}, which is gone") };
    if let Some(robot) = known.get::<RobotId>() {
        return robot.to_string();
    }
    if let Some(message) = known.get::<InFlight>() {
        let packet = &message.packet;
        return format!("{} from {} to {}", packet.kind, packet.from, packet.to);
    }
    if let Some(trailer) = known.get::<Trailer>() {
        return format!("trailer of {}", trailer.of);
    }
    if let Some(visual) = known.get::<BodyVisual>() {
        return format!("picture of {}", name_of(world, visual.body));
    }
    let name = known.get::<Name>().map(Name::as_str);
    match (name, known.get::<Transform>()) {
        (Some("wall"), Some(place)) => {
            let [x, y] = format::coordinates(place.translation.truncate());
            format!("wall at {x}, {y}")
        }
        (Some(name), _) => name.to_owned(),
        (None, _) if known.contains::<Ball>() => "ball".to_owned(),
        (None, _) => by_components(world, entity),
    }
}

/// Components that say little of what an entity is.
const COMMON: [&str; 12] = [
    "Transform",
    "GlobalTransform",
    "TransformTreeChanged",
    "Visibility",
    "InheritedVisibility",
    "ViewVisibility",
    "VisibilityClass",
    "SyncToRenderWorld",
    "RenderEntity",
    "Aabb",
    "Children",
    "NoFrustumCulling",
];

/// The names of the first components that say something, those of this program first.
fn by_components(world: &World, entity: Entity) -> String {
    let components = world.inspect_entity(entity).map(|found| {
        let names = found.map(|info| info.name().to_string());
        names.collect::<Vec<String>>()
    });
    let mut telling: Vec<(bool, String)> = (components.unwrap_or_default().into_iter())
        .map(|path| (!path.starts_with("touchline"), short(&path)))
        .filter(|(_, name)| !COMMON.contains(&name.as_str()))
        .collect();
    telling.sort();
    telling.dedup();
    let first: Vec<String> = telling.into_iter().take(2).map(|(_, name)| name).collect();
    if first.is_empty() { "an entity without components".to_owned() } else { first.join(", ") }
}

/// The name of a type without the paths in it.
fn short(path: &str) -> String {
    let mut short = String::new();
    for part in path.split_inclusive(['<', '>', ',', ' ', '(', ')']) {
        short += part.rsplit("::").next().unwrap_or(part);
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entity_without_a_name_is_called_by_the_components_that_say_something() {
        #[derive(Component)]
        struct Flag;
        let mut world = World::new();
        let flag = world.spawn((Transform::default(), Flag)).id();
        let empty = world.spawn_empty().id();
        assert_eq!(name_of(&world, flag), "Flag");
        assert_eq!(name_of(&world, empty), "an entity without components");
        world.despawn(flag);
        assert!(name_of(&world, flag).ends_with("which is gone"));
    }

    #[test]
    fn paths_are_left_out_of_the_names_of_types() {
        assert_eq!(short("bevy_mesh::components::Mesh2d"), "Mesh2d");
        assert_eq!(short("a::Material<b::c::Colour>"), "Material<Colour>");
    }
}
