//! The topics of a log, each with its schema.

/// A topic of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LogTopic {
    Poses,
    Percepts,
    Beliefs,
    Messages,
    Roles,
    States,
    Bookings,
    Events,
    Frames,
    Pitch,
    Robots,
    BeliefScene,
}

pub(super) struct TopicInfo {
    pub name: &'static str,
    pub schema: &'static str,
    /// The schema itself.
    pub text: &'static str,
}

macro_rules! topics {
    ($($topic:ident $name:literal $schema:literal;)+) => {
        /// In the order of [`LogTopic`].
        pub(super) const TOPICS: [TopicInfo; [$(LogTopic::$topic),+].len()] = [$(TopicInfo {
            name: $name,
            schema: $schema,
            text: include_str!(concat!("schemas/", $schema, ".json")),
        }),+];

        #[cfg(test)]
        const ORDER: &[LogTopic] = &[$(LogTopic::$topic),+];
    };
}

topics! {
    Poses "/poses" "touchline.Poses";
    Percepts "/percepts" "touchline.Percepts";
    Beliefs "/beliefs" "touchline.Beliefs";
    Messages "/messages" "touchline.Message";
    Roles "/roles" "touchline.Role";
    States "/states" "touchline.State";
    Bookings "/bookings" "touchline.Booking";
    Events "/events" "touchline.Event";
    Frames "/tf" "foxglove.FrameTransforms";
    Pitch "/scene/pitch" "foxglove.SceneUpdate";
    Robots "/scene/robots" "foxglove.SceneUpdate";
    BeliefScene "/scene/beliefs" "foxglove.SceneUpdate";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_topic_has_its_place_and_a_schema_of_its_name() {
        for (place, (topic, info)) in ORDER.iter().zip(&TOPICS).enumerate() {
            assert_eq!(*topic as usize, place);
            let schema: serde_json::Value = serde_json::from_str(info.text).expect("a schema is JSON");
            assert_eq!(schema["title"], info.schema);
        }
    }
}
