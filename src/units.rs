//! Units: "60 um" to SI.
