//! The list of bearing models: one line each.

use std::ops::{Deref, DerefMut};

use crate::ball::BallBearing;
use crate::free_ball::FreeBallBearing;
use crate::linear::LinearBearing;
use crate::model::BearingModel;
use crate::radial_ball::RadialBallBearing;

/// Declares [`Bearing`] with a variant per model, which passes every question on to its model.
macro_rules! bearing_models {
    ($($variant:ident($model:ty)),+ $(,)?) => {
        /// A bearing of one of the models; [`BearingModel`] is their interface.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(clippy::large_enum_variant)] // a machine has a handful of bearings
        pub enum Bearing {
            $($variant($model)),+
        }

        impl Bearing {
            /// Names of all models.
            pub const MODELS: &[&str] = &[$(stringify!($variant)),+];
        }

        impl Deref for Bearing {
            type Target = dyn BearingModel;

            fn deref(&self) -> &Self::Target {
                match self {
                    $(Self::$variant(model) => model),+
                }
            }
        }

        impl DerefMut for Bearing {
            fn deref_mut(&mut self) -> &mut Self::Target {
                match self {
                    $(Self::$variant(model) => model),+
                }
            }
        }

        $(impl From<$model> for Bearing {
            fn from(model: $model) -> Self {
                Self::$variant(model)
            }
        })+
    };
}

bearing_models! {
    Linear(LinearBearing),
    Ball(BallBearing),
    RadialBall(RadialBallBearing),
    FreeBall(FreeBallBearing),
}
