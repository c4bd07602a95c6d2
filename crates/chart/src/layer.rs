//! Layers drawn between two axes.

use crate::prelude::*;

/// A side of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Side {
    /// Beyond its right edge.
    Right,
    /// Above it.
    Above,
    /// Below it.
    Below,
}

/// One thing drawn in a panel, with its data in the units of the program.
pub trait Layer: Send + Sync {
    /// Shows every point to `see`, so that the axes hold it; a coordinate that stands for the whole axis is infinite.
    fn extent(&self, _see: &mut dyn FnMut(f64, f64)) {}

    /// Draws what is cut at the frame.
    fn draw(&self, _svg: &mut Svg, _frame: &Frame) {}

    /// Draws what stands over the frame, such as points and labels.
    fn draw_over(&self, _svg: &mut Svg, _frame: &Frame) {}

    /// Legend entries; they are shown if something of the layer is.
    fn keys(&self) -> Vec<(Key, String)> {
        Vec::new()
    }

    /// Whether it is data, and no line or label to compare data with: a panel without data is empty.
    fn is_data(&self) -> bool {
        true
    }

    /// The values that its colours mean.
    fn colours(&self) -> Option<&Colours> {
        None
    }

    /// Whether its lists are as long as they must be and its indices have something behind them.
    fn is_whole(&self) -> bool {
        true
    }

    /// Its numbers.
    fn series(&self) -> Vec<Series> {
        Vec::new()
    }
}

/// Declares [`Drawn`] by its kinds.
macro_rules! drawn {
    ($($kind:ident),+) => {
        /// A layer of any kind.
        #[derive(Serialize, Deserialize)]
        pub enum Drawn {
            $(#[doc = "See the type of this name."] $kind($kind),)+
        }

        $(impl From<$kind> for Drawn {
            fn from(layer: $kind) -> Self {
                Self::$kind(layer)
            }
        })+

        impl std::ops::Deref for Drawn {
            type Target = dyn Layer;

            fn deref(&self) -> &Self::Target {
                match self {
                    $(Self::$kind(layer) => layer,)+
                }
            }
        }
    };
}

drawn!(Bars, Field, Fill, Heat, Label, Line, Points, Rule, Shapes, Surface);
