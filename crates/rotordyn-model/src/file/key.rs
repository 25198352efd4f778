//! Declaration of the keys of the model file: what each is called, what it accepts, what it is without being
//! given, and what it means.
//!
//! The keys of a table are declared with `keys!`, in the file that reads the table; the
//! methods of a reader take declared keys only. The reader, its messages and `rotordyn help` use the same
//! declaration.

use rotordyn_units::Dimension;

/// What is said of a key besides the type of its value.
#[derive(Clone, Copy, Debug)]
pub struct About {
    pub name: &'static str,
    /// What the key means, in one sentence.
    pub meaning: &'static str,
    pub absent: Absent,
    /// Example of assignments in the same table, in TOML, with which the key applies; others may do as well,
    /// as the meaning says. May be empty.
    pub condition: &'static str,
    /// Value as written in a file; empty: the example of its dimension, the default or a word.
    example: &'static str,
}

/// What holds if a key is not given.
#[derive(Clone, Copy, Debug)]
pub enum Absent {
    /// The key must be given.
    Required,
    /// The key must be given in the described case.
    RequiredIf(&'static str),
    /// Nothing: the property does not exist.
    Nothing,
    /// The value as it would be written in a file.
    Default(&'static str),
    /// The value in SI units.
    DefaultSi(f64),
    DefaultCount(usize),
    /// How the value follows from others.
    Computed(&'static str),
}

/// A key of a table, with the type of its value.
#[derive(Clone, Copy, Debug)]
pub struct Key<V> {
    pub about: About,
    pub value: V,
}

/// Range of a quantity, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    Any,
    Positive,
    NotNegative,
    /// Both ends included.
    Within(f64, f64),
    /// The upper end excluded.
    Below(f64, f64),
}

/// Dimension of a quantity and the range it must be in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    pub dimension: Dimension,
    pub range: Range,
}

/// Several quantities of one dimension, and how many, in words.
#[derive(Clone, Copy, Debug)]
pub struct Quantities {
    pub each: Quantity,
    pub count: &'static str,
}

/// Quantities as a list or spaced evenly.
#[derive(Clone, Copy, Debug)]
pub struct Spaced(pub Quantity);

/// Names chosen by the user, each with a quantity: `[station]`.
#[derive(Clone, Copy, Debug)]
pub struct NamedQuantities(pub Quantity);

/// A whole number, ends of the range included.
#[derive(Clone, Copy, Debug)]
pub struct Count {
    pub least: usize,
    pub greatest: usize,
}

/// True or false.
#[derive(Clone, Copy, Debug)]
pub struct Flag;

/// One of several words, with what each stands for.
#[derive(Clone, Copy, Debug)]
pub struct Words<T: 'static>(pub &'static [(&'static str, T)]);

/// Text, and what it names.
#[derive(Clone, Copy, Debug)]
pub struct Text(pub &'static str);

/// One text or several, and what each names.
#[derive(Clone, Copy, Debug)]
pub struct Texts(pub &'static str);

/// Stiffness K of F = K dⁿ, in N/mⁿ, with the exponent as it is written in the unit.
#[derive(Clone, Copy, Debug)]
pub struct PowerStiffness(pub &'static str);

/// A value in a form of its own, described in words.
#[derive(Clone, Copy, Debug)]
pub struct Special(pub &'static str);

/// A table: `[damping]`, `preload = { ... }`.
#[derive(Clone, Copy, Debug)]
pub struct SubTable(pub &'static Table);

/// Tables named by the user: `[bearing.A]`, `[bearing.B]`.
#[derive(Clone, Copy, Debug)]
pub struct NamedTables(pub &'static Table);

/// A list of tables: `[[shaft.section]]`.
#[derive(Clone, Copy, Debug)]
pub struct TableList(pub &'static Table);

/// Keys of a table, in groups.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// What the table describes.
    pub meaning: &'static str,
    pub groups: &'static [Group],
}

/// Keys with a common condition.
#[derive(Clone, Copy, Debug)]
pub struct Group {
    /// Assignments in the table with which the group applies, in TOML; empty: always.
    pub condition: &'static str,
    pub keys: &'static [&'static dyn Declared],
}

impl Group {
    pub const fn always(keys: &'static [&'static dyn Declared]) -> Self {
        Self { condition: "", keys }
    }
}

impl Table {
    /// Every declared key; a key with two forms is declared once for each.
    pub fn keys(&self) -> impl Iterator<Item = &'static dyn Declared> {
        self.groups.iter().flat_map(|group| group.keys.iter().copied())
    }
}

/// Type of a key's value, for descriptions.
#[derive(Clone, Debug)]
pub enum ValueKind {
    Quantity(Quantity),
    Quantities(Quantities),
    Spaced(Quantity),
    NamedQuantities(Quantity),
    Count(Count),
    Flag,
    Words(Vec<&'static str>),
    Text(&'static str),
    Texts(&'static str),
    PowerStiffness(&'static str),
    Special(&'static str),
    SubTable(&'static Table),
    NamedTables(&'static Table),
    TableList(&'static Table),
}

/// A declared key whose type of value does not matter.
pub trait Declared: Sync + std::fmt::Debug {
    fn about(&self) -> &About;
    fn kind(&self) -> ValueKind;

    fn name(&self) -> &'static str {
        self.about().name
    }

    /// Whether it is the same key (perhaps in another form).
    fn is(&self, other: &dyn Declared) -> bool {
        self.name() == other.name()
    }

    /// Value as it could be written in a file; empty for a table.
    fn example(&self) -> String {
        let about = self.about();
        match (about.example, about.absent, self.kind()) {
            ("", Absent::Default(text), kind) => kind.written(text),
            ("", _, kind) => kind.example(),
            (given, ..) => given.into(),
        }
    }

    /// Default as it would be written in a file; `None` without a fixed default.
    fn default_text(&self) -> Option<String> {
        match (self.about().absent, self.kind()) {
            (Absent::Default(text), kind) => Some(kind.written(text)),
            (Absent::DefaultSi(value), ValueKind::Quantity(quantity)) => {
                let text = format!("{value:?} {}", quantity.dimension.unit);
                Some(ValueKind::Quantity(quantity).written(text.trim()))
            }
            (Absent::DefaultCount(value), _) => Some(value.to_string()),
            _ => None,
        }
    }
}

impl ValueKind {
    /// Text as it is written in a file: quoted, unless it is a number, a flag, a list or a table.
    fn written(&self, text: &str) -> String {
        let plain = matches!(self, Self::Count(_) | Self::Flag) || text.starts_with(['[', '{']);
        if plain || text.parse::<f64>().is_ok() { text.into() } else { format!("\"{text}\"") }
    }

    fn example(&self) -> String {
        match self {
            Self::Quantity(of) | Self::Spaced(of) | Self::Quantities(Quantities { each: of, .. }) => {
                self.written(of.dimension.example)
            }
            Self::Count(Count { least, .. }) => least.to_string(),
            Self::Flag => "true".into(),
            Self::Words(words) => words.first().map(|word| format!("\"{word}\"")).unwrap_or_default(),
            Self::PowerStiffness(exponent) => format!("\"1e10 N/m^{exponent}\""),
            Self::Text(_) | Self::Texts(_) | Self::Special(_) => String::new(),
            Self::NamedQuantities(_) | Self::SubTable(_) | Self::NamedTables(_) | Self::TableList(_) => {
                String::new()
            }
        }
    }
}

/// Types of values.
pub trait ValueType: Copy + Sync + std::fmt::Debug {
    fn kind(&self) -> ValueKind;
}

impl<V: ValueType> Declared for Key<V> {
    fn about(&self) -> &About {
        &self.about
    }

    fn kind(&self) -> ValueKind {
        self.value.kind()
    }
}

impl<T: Copy + Sync + std::fmt::Debug> ValueType for Words<T> {
    fn kind(&self) -> ValueKind {
        ValueKind::Words(self.0.iter().map(|(word, _)| *word).collect())
    }
}

impl ValueType for Flag {
    fn kind(&self) -> ValueKind {
        ValueKind::Flag
    }
}

/// Value types whose description is a copy of their content.
macro_rules! described {
    ($($type:ident: $field:tt,)*) => {
        $(impl ValueType for $type {
            fn kind(&self) -> ValueKind {
                ValueKind::$type(self.$field)
            }
        })*
    };
}

described! {
    Spaced: 0, NamedQuantities: 0, Text: 0, Texts: 0, PowerStiffness: 0, Special: 0, SubTable: 0,
    NamedTables: 0, TableList: 0,
}

impl ValueType for Quantity {
    fn kind(&self) -> ValueKind {
        ValueKind::Quantity(*self)
    }
}

impl ValueType for Quantities {
    fn kind(&self) -> ValueKind {
        ValueKind::Quantities(*self)
    }
}

impl ValueType for Count {
    fn kind(&self) -> ValueKind {
        ValueKind::Count(*self)
    }
}

const fn key<V: Copy>(value: V, meaning: &'static str) -> Key<V> {
    let about = About { name: "", meaning, absent: Absent::Required, condition: "", example: "" };
    Key { about, value }
}

impl<V: Copy> Key<V> {
    /// Name of the key, unless it has been named.
    pub const fn named(mut self, name: &'static str) -> Self {
        if self.about.name.is_empty() {
            self.about.name = name;
        }
        self
    }

    const fn absent(mut self, absent: Absent) -> Self {
        self.about.absent = absent;
        self
    }

    pub const fn default(self, text: &'static str) -> Self {
        self.absent(Absent::Default(text))
    }

    /// Default that another layer defines, in SI units.
    pub const fn default_si(self, value: f64) -> Self {
        self.absent(Absent::DefaultSi(value))
    }

    /// Default that another layer defines.
    pub const fn default_count(self, value: usize) -> Self {
        self.absent(Absent::DefaultCount(value))
    }

    /// The property does not exist if the key is absent.
    pub const fn optional(self) -> Self {
        self.absent(Absent::Nothing)
    }

    /// How the default follows from other values.
    pub const fn computed(self, words: &'static str) -> Self {
        self.absent(Absent::Computed(words))
    }

    /// In which case the key is required.
    pub const fn required(self, words: &'static str) -> Self {
        self.absent(Absent::RequiredIf(words))
    }

    /// Example of assignments in the same table, in TOML, with which the key applies.
    pub const fn with(mut self, condition: &'static str) -> Self {
        self.about.condition = condition;
        self
    }

    pub const fn example(mut self, example: &'static str) -> Self {
        self.about.example = example;
        self
    }
}

impl<T: Copy> Key<Words<T>> {
    /// What the default stands for; the first word without default.
    pub fn default_word(&self) -> T {
        let default = match self.about.absent {
            Absent::Default(text) => text,
            _ => "",
        };
        let words = self.value.0;
        words.iter().find(|(word, _)| *word == default).unwrap_or(&words[0]).1
    }
}

pub const fn any(dimension: Dimension) -> Quantity {
    Quantity { dimension, range: Range::Any }
}

pub const fn positive(dimension: Dimension) -> Quantity {
    Quantity { dimension, range: Range::Positive }
}

pub const fn not_negative(dimension: Dimension) -> Quantity {
    Quantity { dimension, range: Range::NotNegative }
}

/// From the least to the greatest value, in SI units, both included.
pub const fn within(dimension: Dimension, [least, greatest]: [f64; 2]) -> Quantity {
    Quantity { dimension, range: Range::Within(least, greatest) }
}

/// From the least value, included, to below the limit, in SI units.
pub const fn below(dimension: Dimension, [least, limit]: [f64; 2]) -> Quantity {
    Quantity { dimension, range: Range::Below(least, limit) }
}

pub const fn quantity(value: Quantity, meaning: &'static str) -> Key<Quantity> {
    key(value, meaning)
}

/// `count`: how many, in words.
pub const fn quantities(each: Quantity, count: &'static str, meaning: &'static str) -> Key<Quantities> {
    key(Quantities { each, count }, meaning)
}

pub const fn spaced(each: Quantity, meaning: &'static str) -> Key<Spaced> {
    key(Spaced(each), meaning)
}

pub const fn named_quantities(each: Quantity, meaning: &'static str) -> Key<NamedQuantities> {
    key(NamedQuantities(each), meaning)
}

/// `range`: least and greatest number.
pub const fn count([least, greatest]: [usize; 2], meaning: &'static str) -> Key<Count> {
    key(Count { least, greatest }, meaning)
}

pub const fn flag(meaning: &'static str) -> Key<Flag> {
    key(Flag, meaning)
}

pub const fn words<T: Copy>(words: &'static [(&'static str, T)], meaning: &'static str) -> Key<Words<T>> {
    key(Words(words), meaning)
}

/// `what`: what the text is.
pub const fn text(what: &'static str, meaning: &'static str) -> Key<Text> {
    key(Text(what), meaning)
}

/// `what`: what each text is.
pub const fn texts(what: &'static str, meaning: &'static str) -> Key<Texts> {
    key(Texts(what), meaning)
}

/// `exponent`: as it is written in the unit.
pub const fn power_stiffness(exponent: &'static str, meaning: &'static str) -> Key<PowerStiffness> {
    key(PowerStiffness(exponent), meaning)
}

/// `what`: the form of the value.
pub const fn special(what: &'static str, meaning: &'static str) -> Key<Special> {
    key(Special(what), meaning)
}

/// A table that may be absent.
pub const fn sub_table(table: &'static Table) -> Key<SubTable> {
    key(SubTable(table), table.meaning).optional()
}

/// Tables of which there may be none.
pub const fn named_tables(table: &'static Table) -> Key<NamedTables> {
    key(NamedTables(table), table.meaning).optional()
}

/// Tables of which there may be none.
pub const fn table_list(table: &'static Table) -> Key<TableList> {
    key(TableList(table), table.meaning).optional()
}

/// Declares keys: a struct with one field per key, named as in the file, and a static of it; `LIST` has all its
/// keys. With a meaning they are all keys of one table, `TABLE`.
macro_rules! keys {
    ($(#[$doc:meta])* $vis:vis static $NAME:ident: $Type:ident = $meaning:literal { $($keys:tt)* }) => {
        $crate::file::key::keys! { $(#[$doc])* $vis static $NAME: $Type { $($keys)* } }

        impl $Type {
            $vis const TABLE: &'static $crate::file::key::Table = &$crate::file::key::Table {
                meaning: $meaning,
                groups: &[$crate::file::key::Group::always(Self::LIST)],
            };
        }
    };
    ($(#[$doc:meta])* $vis:vis static $NAME:ident: $Type:ident {
        $($(#[$note:meta])* $field:ident: $V:ty = $key:expr;)*
    }) => {
        $(#[$doc])*
        $vis struct $Type {
            $($(#[$note])* $vis $field: $crate::file::key::Key<$V>,)*
        }

        $(#[$doc])*
        $vis static $NAME: $Type = $Type { $($field: $key.named(stringify!($field)),)* };

        impl $Type {
            $vis const LIST: &'static [&'static dyn $crate::file::key::Declared] = &[$(&$NAME.$field,)*];
        }
    };
}
pub(crate) use keys;
