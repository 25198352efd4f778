"""Parts of a model, a class for each table of the model file. Written by make_parts.py; not to be edited."""

from __future__ import annotations

from typing import Any, Literal, Mapping, Sequence

from ._part import Part

__all__ = [
    "BallBearing",
    "Belt",
    "Body",
    "Bushing",
    "Damping",
    "Disc",
    "Drive",
    "FreeBallBearing",
    "Housing",
    "Joint",
    "Layer",
    "LinearBearing",
    "Load",
    "Lubricant",
    "Material",
    "Part",
    "Probe",
    "RadialBallBearing",
    "RigidRotor",
    "Section",
    "Sensor",
    "Shaft",
    "ShaftUnbalance",
    "SpeedProfile",
]


class Material(Part):
    """An elastic material. ``[material.NAME]`` of the model file.

    ``young`` (pressure or modulus, greater than zero): Young's modulus. Required.
    ``density`` (density, zero or greater): Density. Required.
    ``poisson`` (number, from -0.99 to 0.5): Poisson's ratio. Without it: required, or shear.
    ``shear`` (pressure or modulus, greater than zero): Shear modulus; with poisson it need not be E / (2 (1 +
        nu)). Without it: required, or poisson.
    """

    _table = "material"

    def __init__(
        self,
        name: str,
        *,
        young: str | None = None,
        density: str | None = None,
        poisson: float | None = None,
        shear: str | None = None,
    ) -> None:
        super().__init__(name, {
            "young": young,
            "density": density,
            "poisson": poisson,
            "shear": shear,
        })


class Lubricant(Part):
    """An oil at its operating temperature, by its viscosity grade or its properties. ``[lubricant.NAME]`` of the
    model file.

    ``grade`` (a viscosity grade): Viscosity grade of ISO 3448 of a mineral oil. Without it: required, or
        viscosity.
    ``temperature`` (temperature, from -10 to 130 degC): Temperature of the oil, of any grade. Without it:
        required, with grade. With grade = "ISO VG 68".
    ``viscosity`` (dynamic viscosity, greater than zero): Dynamic viscosity at the operating temperature.
        Without it: required, or grade.
    ``pressure_viscosity`` (pressure-viscosity coefficient, greater than zero): Pressure-viscosity
        coefficient. Without it: required, with viscosity; of a grade from its viscosity.
    ``density`` (density, greater than zero): Density; by default of a mineral oil, that of a grade at its
        temperature. Without it: "870 kg/m^3".
    """

    _table = "lubricant"

    def __init__(
        self,
        name: str,
        *,
        grade: str | None = None,
        temperature: str | None = None,
        viscosity: str | None = None,
        pressure_viscosity: str | None = None,
        density: str | None = None,
    ) -> None:
        super().__init__(name, {
            "grade": grade,
            "temperature": temperature,
            "viscosity": viscosity,
            "pressure_viscosity": pressure_viscosity,
            "density": density,
        })


class Section(Part):
    """A cylinder or cone, solid or hollow; properties of the shaft may be overridden. ``[[shaft.section]]`` of the
    model file.

    ``from_`` (length): Position of its first end. Without it: the end of the previous section.
    ``gap`` (true or false): Whether there is no shaft, only what connects its ends, such as a coupling;
        diameters are for drawings. Without it: false.
    ``to`` (length): Position of its other end. Without it: required, or length.
    ``length`` (length, greater than zero): Length. Without it: required, or to.
    ``outer_diameter`` (length, greater than zero): Outer diameter, of a cone at its first end. Required.
    ``outer_diameter_end`` (length, greater than zero): Outer diameter of a cone at its other end. Without it:
        outer_diameter.
    ``inner_diameter`` (length, zero or greater): Diameter of the bore. Without it: "0 mm".
    ``inner_diameter_end`` (length, zero or greater): Diameter of the bore at its other end. Without it:
        inner_diameter.
    ``element_length`` (length, greater than zero): Greatest length of an element. Without it: required, in
        [shaft].
    ``material`` (name of a material): Material. Without it: the only material of the file.
    ``shear`` ("cowper", "hutchinson", "none" or number, greater than zero): Shear coefficient of a Timoshenko
        beam; none: rigid in shear. Shear coefficient, as a number. Without it: "cowper".
    ``rotary_inertia`` (true or false): Whether the cross sections have moments of inertia. Without it: true.
    ``axial_force`` (force): Tension of the shaft; negative: compression. Without it: "0 N".
    ``torque`` (moment): Torque that the shaft transmits. Without it: "0 N m".
    ``mass_damping`` (rate, zero or greater): Rayleigh damping, factor of the mass matrix. Without it: "0
        1/s".
    ``stiffness_damping`` (time, zero or greater): Rayleigh damping, factor of the stiffness matrix. Without
        it: "0 s".
    ``internal_damping`` (time, zero or greater): Internal (rotating) damping, factor of the stiffness matrix
        in the rotating frame. Without it: "0 s".
    """

    _table = "shaft.section"

    def __init__(
        self,
        *,
        from_: str | None = None,
        gap: bool | None = None,
        to: str | None = None,
        length: str | None = None,
        outer_diameter: str | None = None,
        outer_diameter_end: str | None = None,
        inner_diameter: str | None = None,
        inner_diameter_end: str | None = None,
        element_length: str | None = None,
        material: str | None = None,
        shear: Literal["cowper", "hutchinson", "none"] | float | None = None,
        rotary_inertia: bool | None = None,
        axial_force: str | None = None,
        torque: str | None = None,
        mass_damping: str | None = None,
        stiffness_damping: str | None = None,
        internal_damping: str | None = None,
    ) -> None:
        super().__init__(None, {
            "from": from_,
            "gap": gap,
            "to": to,
            "length": length,
            "outer_diameter": outer_diameter,
            "outer_diameter_end": outer_diameter_end,
            "inner_diameter": inner_diameter,
            "inner_diameter_end": inner_diameter_end,
            "element_length": element_length,
            "material": material,
            "shear": shear,
            "rotary_inertia": rotary_inertia,
            "axial_force": axial_force,
            "torque": torque,
            "mass_damping": mass_damping,
            "stiffness_damping": stiffness_damping,
            "internal_damping": internal_damping,
        })


class Layer(Part):
    """A sleeve on the shaft's nodes, whose stiffness and inertia are added to those of the sections; nodes are at
    its ends. ``[[shaft.layer]]`` of the model file.

    ``from_`` (length): Position of its first end, on the shaft. Required.
    ``to`` (length): Position of its other end. Without it: required, or length.
    ``length`` (length, greater than zero): Length. Without it: required, or to.
    ``outer_diameter`` (length, greater than zero): Outer diameter, of a cone at its first end. Required.
    ``outer_diameter_end`` (length, greater than zero): Outer diameter of a cone at its other end. Without it:
        outer_diameter.
    ``inner_diameter`` (length, zero or greater): Diameter of the bore. Without it: "0 mm".
    ``inner_diameter_end`` (length, zero or greater): Diameter of the bore at its other end. Without it:
        inner_diameter.
    ``element_length`` (length, greater than zero): Greatest length of an element. Without it: required, in
        [shaft].
    ``material`` (name of a material): Material. Without it: the only material of the file.
    ``shear`` ("cowper", "hutchinson", "none" or number, greater than zero): Shear coefficient of a Timoshenko
        beam; none: rigid in shear. Shear coefficient, as a number. Without it: "cowper".
    ``rotary_inertia`` (true or false): Whether the cross sections have moments of inertia. Without it: true.
    ``axial_force`` (force): Tension of the shaft; negative: compression. Without it: "0 N".
    ``torque`` (moment): Torque that the shaft transmits. Without it: "0 N m".
    ``mass_damping`` (rate, zero or greater): Rayleigh damping, factor of the mass matrix. Without it: "0
        1/s".
    ``stiffness_damping`` (time, zero or greater): Rayleigh damping, factor of the stiffness matrix. Without
        it: "0 s".
    ``internal_damping`` (time, zero or greater): Internal (rotating) damping, factor of the stiffness matrix
        in the rotating frame. Without it: "0 s".
    """

    _table = "shaft.layer"

    def __init__(
        self,
        *,
        from_: str | None = None,
        to: str | None = None,
        length: str | None = None,
        outer_diameter: str | None = None,
        outer_diameter_end: str | None = None,
        inner_diameter: str | None = None,
        inner_diameter_end: str | None = None,
        element_length: str | None = None,
        material: str | None = None,
        shear: Literal["cowper", "hutchinson", "none"] | float | None = None,
        rotary_inertia: bool | None = None,
        axial_force: str | None = None,
        torque: str | None = None,
        mass_damping: str | None = None,
        stiffness_damping: str | None = None,
        internal_damping: str | None = None,
    ) -> None:
        super().__init__(None, {
            "from": from_,
            "to": to,
            "length": length,
            "outer_diameter": outer_diameter,
            "outer_diameter_end": outer_diameter_end,
            "inner_diameter": inner_diameter,
            "inner_diameter_end": inner_diameter_end,
            "element_length": element_length,
            "material": material,
            "shear": shear,
            "rotary_inertia": rotary_inertia,
            "axial_force": axial_force,
            "torque": torque,
            "mass_damping": mass_damping,
            "stiffness_damping": stiffness_damping,
            "internal_damping": internal_damping,
        })


class Shaft(Part):
    """A flexible shaft of sections; an automatic mesh has a node at every section end and station. ``[shaft]`` of
    the model file.

    ``start`` (length): Position of its first end. Without it: "0 m".
    ``minimum_spacing`` (length, greater than zero): Smallest distance of nodes. Without it: "100 um".
    ``section`` (list of tables): A cylinder or cone, solid or hollow; properties of the shaft may be
        overridden. Required.
    ``layer`` (list of tables): A sleeve on the shaft's nodes, whose stiffness and inertia are added to those
        of the sections; nodes are at its ends.
    ``element_length`` (length, greater than zero): Greatest length of an element. Without it: required, in
        [shaft].
    ``material`` (name of a material): Material. Without it: the only material of the file.
    ``shear`` ("cowper", "hutchinson", "none" or number, greater than zero): Shear coefficient of a Timoshenko
        beam; none: rigid in shear. Shear coefficient, as a number. Without it: "cowper".
    ``rotary_inertia`` (true or false): Whether the cross sections have moments of inertia. Without it: true.
    ``axial_force`` (force): Tension of the shaft; negative: compression. Without it: "0 N".
    ``torque`` (moment): Torque that the shaft transmits. Without it: "0 N m".
    ``mass_damping`` (rate, zero or greater): Rayleigh damping, factor of the mass matrix. Without it: "0
        1/s".
    ``stiffness_damping`` (time, zero or greater): Rayleigh damping, factor of the stiffness matrix. Without
        it: "0 s".
    ``internal_damping`` (time, zero or greater): Internal (rotating) damping, factor of the stiffness matrix
        in the rotating frame. Without it: "0 s".
    """

    _table = "shaft"
    _lists = ("section", "layer",)

    def __init__(
        self,
        *,
        start: str | None = None,
        minimum_spacing: str | None = None,
        section: Sequence[Section | Mapping[str, Any]] | None = None,
        layer: Sequence[Layer | Mapping[str, Any]] | None = None,
        element_length: str | None = None,
        material: str | None = None,
        shear: Literal["cowper", "hutchinson", "none"] | float | None = None,
        rotary_inertia: bool | None = None,
        axial_force: str | None = None,
        torque: str | None = None,
        mass_damping: str | None = None,
        stiffness_damping: str | None = None,
        internal_damping: str | None = None,
    ) -> None:
        super().__init__(None, {
            "start": start,
            "minimum_spacing": minimum_spacing,
            "section": section,
            "layer": layer,
            "element_length": element_length,
            "material": material,
            "shear": shear,
            "rotary_inertia": rotary_inertia,
            "axial_force": axial_force,
            "torque": torque,
            "mass_damping": mass_damping,
            "stiffness_damping": stiffness_damping,
            "internal_damping": internal_damping,
        })


class RigidRotor(Part):
    """A rigid rotor instead of a flexible shaft: by mass and inertia, or a cylinder. ``[rotor]`` of the model file.

    ``centre`` (length): Position of the centre of mass along z. Required.
    ``length`` (length, greater than zero): Length of the cylinder; the stations lie on it. Without it:
        required, without inertia.
    ``outer_diameter`` (length, greater than zero): Diameter of the cylinder. Without it: required, without
        inertia.
    ``inner_diameter`` (length, zero or greater): Diameter of its bore. Without it: "0 mm".
    ``material`` (name of a material): Material of the cylinder; or give its mass. Without it: the only
        material of the file.
    ``mass`` (mass, greater than zero): Mass. Without it: required, with inertia.
    ``polar_inertia`` (moment of inertia, zero or greater): Moment of inertia about z. Without it: required,
        or length and outer_diameter.
    ``diametral_inertia`` (moment of inertia, greater than zero): Moment of inertia about x and y. Without it:
        required, with polar_inertia.
    ``minimum_spacing`` (length, greater than zero): Smallest distance of two stations. Without it: "100 um".
    """

    _table = "rotor"

    def __init__(
        self,
        *,
        centre: str | None = None,
        length: str | None = None,
        outer_diameter: str | None = None,
        inner_diameter: str | None = None,
        material: str | None = None,
        mass: str | None = None,
        polar_inertia: str | None = None,
        diametral_inertia: str | None = None,
        minimum_spacing: str | None = None,
    ) -> None:
        super().__init__(None, {
            "centre": centre,
            "length": length,
            "outer_diameter": outer_diameter,
            "inner_diameter": inner_diameter,
            "material": material,
            "mass": mass,
            "polar_inertia": polar_inertia,
            "diametral_inertia": diametral_inertia,
            "minimum_spacing": minimum_spacing,
        })


class Disc(Part):
    """A disc on the shaft, by its dimensions or by its mass. ``[disc.NAME]`` of the model file.

    ``station`` (name of a station): Where it sits. Required.
    ``outer_diameter`` (length, greater than zero): Outer diameter; with a mass only for pictures. Without it:
        required, without mass.
    ``inner_diameter`` (length, zero or greater): Diameter of the bore. Without it: "0 mm".
    ``thickness`` (length, greater than zero): Length along the shaft; with a mass only for pictures. Without
        it: required, without mass.
    ``material`` (name of a material): Material of a disc by dimensions. Without it: the only material of the
        file.
    ``mass`` (mass, greater than zero): Mass, instead of dimensions and material. Without it: required, with
        inertia.
    ``polar_inertia`` (moment of inertia, zero or greater): Moment of inertia about z. Without it: required,
        with mass.
    ``diametral_inertia`` (moment of inertia, zero or greater): Moment of inertia about x and y. Without it:
        required, with mass.
    """

    _table = "disc"

    def __init__(
        self,
        name: str,
        *,
        station: str | None = None,
        outer_diameter: str | None = None,
        inner_diameter: str | None = None,
        thickness: str | None = None,
        material: str | None = None,
        mass: str | None = None,
        polar_inertia: str | None = None,
        diametral_inertia: str | None = None,
    ) -> None:
        super().__init__(name, {
            "station": station,
            "outer_diameter": outer_diameter,
            "inner_diameter": inner_diameter,
            "thickness": thickness,
            "material": material,
            "mass": mass,
            "polar_inertia": polar_inertia,
            "diametral_inertia": diametral_inertia,
        })


class Body(Part):
    """A rigid body. ``[body.NAME]`` of the model file.

    ``station`` (name of a station): Station at the centre of mass. Without it: required, or position.
    ``offset`` (length: three: x, y, z): Distance of the centre of mass from the station. Without it: "0, 0, 0
        m". With station = "A".
    ``position`` (length: three: x, y, z): Position of the centre of mass. Without it: required, or station.
    ``mass`` (mass: one, or three: x, y, z, greater than zero): Mass; by axis for the modal mass of a support.
        Required.
    ``inertia`` (moment of inertia: one, or three: xx, yy, zz): Moments of inertia about the centre of mass.
        Required.
    ``inertia_products`` (moment of inertia: three: xy, yz, zx): Off-diagonal elements of the inertia tensor.
        Without it: "0, 0, 0 kg m^2".
    """

    _table = "body"

    def __init__(
        self,
        name: str,
        *,
        station: str | None = None,
        offset: str | Sequence[str] | None = None,
        position: str | Sequence[str] | None = None,
        mass: str | Sequence[str] | None = None,
        inertia: str | Sequence[str] | None = None,
        inertia_products: str | Sequence[str] | None = None,
    ) -> None:
        super().__init__(name, {
            "station": station,
            "offset": offset,
            "position": position,
            "mass": mass,
            "inertia": inertia,
            "inertia_products": inertia_products,
        })


class Housing(Part):
    """A rigid body that holds a bearing, on springs: k_x, k_y, k_z, k_tilt and k_spin are required.
    ``[housing.NAME]`` of the model file.

    ``station`` (name of a station): Station at the centre of mass. Without it: required, or position.
    ``offset`` (length: three: x, y, z): Distance of the centre of mass from the station. Without it: "0, 0, 0
        m". With station = "A".
    ``position`` (length: three: x, y, z): Position of the centre of mass. Without it: required, or station.
    ``mass`` (mass: one, or three: x, y, z, greater than zero): Mass; by axis for the modal mass of a support.
        Required.
    ``inertia`` (moment of inertia: one, or three: xx, yy, zz): Moments of inertia about the centre of mass.
        Required.
    ``inertia_products`` (moment of inertia: three: xy, yz, zx): Off-diagonal elements of the inertia tensor.
        Without it: "0, 0, 0 kg m^2".
    ``on`` (ground or name of a body): What its springs stand on. Without it: "ground".
    ``k_tilt`` (rotational stiffness: one, zero or greater): Both tilts, about x and about y. Without it: 0.
    ``k_x`` (stiffness: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``k_y`` (stiffness: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``k_z`` (stiffness: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``k_tilt_x`` (rotational stiffness: one, zero or greater): Translation along an axis, tilt about it, or
        spin about z. Without it: 0.
    ``k_tilt_y`` (rotational stiffness: one, zero or greater): Translation along an axis, tilt about it, or
        spin about z. Without it: 0.
    ``k_spin`` (rotational stiffness: one, zero or greater): Translation along an axis, tilt about it, or spin
        about z. Without it: 0.
    ``k_xx`` (stiffness: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``k_xy`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_xz`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_xtx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_xty`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_xtz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_yx`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_yy`` (stiffness: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``k_yz`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_ytx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_yty`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_ytz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_zx`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_zy`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_zz`` (stiffness: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``k_ztx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_zty`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_ztz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txy`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txtx`` (rotational stiffness: one, zero or greater): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txty`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_txtz`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tyx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tyy`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tyz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tytx`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tyty`` (rotational stiffness: one, zero or greater): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tytz`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tzx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tzy`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tzz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tztx`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tzty`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tztz`` (rotational stiffness: one, zero or greater): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``c_tilt`` (rotational damping: one, zero or greater): Both tilts, about x and about y. Without it: 0.
    ``c_x`` (damping: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``c_y`` (damping: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``c_z`` (damping: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``c_tilt_x`` (rotational damping: one, zero or greater): Translation along an axis, tilt about it, or spin
        about z. Without it: 0.
    ``c_tilt_y`` (rotational damping: one, zero or greater): Translation along an axis, tilt about it, or spin
        about z. Without it: 0.
    ``c_spin`` (rotational damping: one, zero or greater): Translation along an axis, tilt about it, or spin
        about z. Without it: 0.
    ``c_xx`` (damping: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_xy`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_xz`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_xtx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_xty`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_xtz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_yx`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_yy`` (damping: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_yz`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_ytx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_yty`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_ytz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_zx`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_zy`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_zz`` (damping: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_ztx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_zty`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_ztz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txy`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txtx`` (rotational damping: one, zero or greater): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txty`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_txtz`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tyx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tyy`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tyz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tytx`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tyty`` (rotational damping: one, zero or greater): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tytz`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tzx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tzy`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tzz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tztx`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tzty`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tztz`` (rotational damping: one, zero or greater): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``stiffness_si`` (number: 6 x 6 in SI units): Whole matrix, rows and columns u_x u_y u_z theta_x theta_y
        theta_z. Without it: from its components.
    ``damping_si`` (number: 6 x 6 in SI units): Whole matrix, rows and columns u_x u_y u_z theta_x theta_y
        theta_z. Without it: from its components.
    """

    _table = "housing"

    def __init__(
        self,
        name: str,
        *,
        station: str | None = None,
        offset: str | Sequence[str] | None = None,
        position: str | Sequence[str] | None = None,
        mass: str | Sequence[str] | None = None,
        inertia: str | Sequence[str] | None = None,
        inertia_products: str | Sequence[str] | None = None,
        on: str | None = None,
        k_tilt: str | Sequence[str] | None = None,
        k_x: str | Sequence[str] | None = None,
        k_y: str | Sequence[str] | None = None,
        k_z: str | Sequence[str] | None = None,
        k_tilt_x: str | Sequence[str] | None = None,
        k_tilt_y: str | Sequence[str] | None = None,
        k_spin: str | Sequence[str] | None = None,
        k_xx: str | Sequence[str] | None = None,
        k_xy: str | Sequence[str] | None = None,
        k_xz: str | Sequence[str] | None = None,
        k_xtx: str | Sequence[str] | None = None,
        k_xty: str | Sequence[str] | None = None,
        k_xtz: str | Sequence[str] | None = None,
        k_yx: str | Sequence[str] | None = None,
        k_yy: str | Sequence[str] | None = None,
        k_yz: str | Sequence[str] | None = None,
        k_ytx: str | Sequence[str] | None = None,
        k_yty: str | Sequence[str] | None = None,
        k_ytz: str | Sequence[str] | None = None,
        k_zx: str | Sequence[str] | None = None,
        k_zy: str | Sequence[str] | None = None,
        k_zz: str | Sequence[str] | None = None,
        k_ztx: str | Sequence[str] | None = None,
        k_zty: str | Sequence[str] | None = None,
        k_ztz: str | Sequence[str] | None = None,
        k_txx: str | Sequence[str] | None = None,
        k_txy: str | Sequence[str] | None = None,
        k_txz: str | Sequence[str] | None = None,
        k_txtx: str | Sequence[str] | None = None,
        k_txty: str | Sequence[str] | None = None,
        k_txtz: str | Sequence[str] | None = None,
        k_tyx: str | Sequence[str] | None = None,
        k_tyy: str | Sequence[str] | None = None,
        k_tyz: str | Sequence[str] | None = None,
        k_tytx: str | Sequence[str] | None = None,
        k_tyty: str | Sequence[str] | None = None,
        k_tytz: str | Sequence[str] | None = None,
        k_tzx: str | Sequence[str] | None = None,
        k_tzy: str | Sequence[str] | None = None,
        k_tzz: str | Sequence[str] | None = None,
        k_tztx: str | Sequence[str] | None = None,
        k_tzty: str | Sequence[str] | None = None,
        k_tztz: str | Sequence[str] | None = None,
        c_tilt: str | Sequence[str] | None = None,
        c_x: str | Sequence[str] | None = None,
        c_y: str | Sequence[str] | None = None,
        c_z: str | Sequence[str] | None = None,
        c_tilt_x: str | Sequence[str] | None = None,
        c_tilt_y: str | Sequence[str] | None = None,
        c_spin: str | Sequence[str] | None = None,
        c_xx: str | Sequence[str] | None = None,
        c_xy: str | Sequence[str] | None = None,
        c_xz: str | Sequence[str] | None = None,
        c_xtx: str | Sequence[str] | None = None,
        c_xty: str | Sequence[str] | None = None,
        c_xtz: str | Sequence[str] | None = None,
        c_yx: str | Sequence[str] | None = None,
        c_yy: str | Sequence[str] | None = None,
        c_yz: str | Sequence[str] | None = None,
        c_ytx: str | Sequence[str] | None = None,
        c_yty: str | Sequence[str] | None = None,
        c_ytz: str | Sequence[str] | None = None,
        c_zx: str | Sequence[str] | None = None,
        c_zy: str | Sequence[str] | None = None,
        c_zz: str | Sequence[str] | None = None,
        c_ztx: str | Sequence[str] | None = None,
        c_zty: str | Sequence[str] | None = None,
        c_ztz: str | Sequence[str] | None = None,
        c_txx: str | Sequence[str] | None = None,
        c_txy: str | Sequence[str] | None = None,
        c_txz: str | Sequence[str] | None = None,
        c_txtx: str | Sequence[str] | None = None,
        c_txty: str | Sequence[str] | None = None,
        c_txtz: str | Sequence[str] | None = None,
        c_tyx: str | Sequence[str] | None = None,
        c_tyy: str | Sequence[str] | None = None,
        c_tyz: str | Sequence[str] | None = None,
        c_tytx: str | Sequence[str] | None = None,
        c_tyty: str | Sequence[str] | None = None,
        c_tytz: str | Sequence[str] | None = None,
        c_tzx: str | Sequence[str] | None = None,
        c_tzy: str | Sequence[str] | None = None,
        c_tzz: str | Sequence[str] | None = None,
        c_tztx: str | Sequence[str] | None = None,
        c_tzty: str | Sequence[str] | None = None,
        c_tztz: str | Sequence[str] | None = None,
        stiffness_si: float | Sequence[float] | str | None = None,
        damping_si: float | Sequence[float] | str | None = None,
    ) -> None:
        super().__init__(name, {
            "station": station,
            "offset": offset,
            "position": position,
            "mass": mass,
            "inertia": inertia,
            "inertia_products": inertia_products,
            "on": on,
            "k_tilt": k_tilt,
            "k_x": k_x,
            "k_y": k_y,
            "k_z": k_z,
            "k_tilt_x": k_tilt_x,
            "k_tilt_y": k_tilt_y,
            "k_spin": k_spin,
            "k_xx": k_xx,
            "k_xy": k_xy,
            "k_xz": k_xz,
            "k_xtx": k_xtx,
            "k_xty": k_xty,
            "k_xtz": k_xtz,
            "k_yx": k_yx,
            "k_yy": k_yy,
            "k_yz": k_yz,
            "k_ytx": k_ytx,
            "k_yty": k_yty,
            "k_ytz": k_ytz,
            "k_zx": k_zx,
            "k_zy": k_zy,
            "k_zz": k_zz,
            "k_ztx": k_ztx,
            "k_zty": k_zty,
            "k_ztz": k_ztz,
            "k_txx": k_txx,
            "k_txy": k_txy,
            "k_txz": k_txz,
            "k_txtx": k_txtx,
            "k_txty": k_txty,
            "k_txtz": k_txtz,
            "k_tyx": k_tyx,
            "k_tyy": k_tyy,
            "k_tyz": k_tyz,
            "k_tytx": k_tytx,
            "k_tyty": k_tyty,
            "k_tytz": k_tytz,
            "k_tzx": k_tzx,
            "k_tzy": k_tzy,
            "k_tzz": k_tzz,
            "k_tztx": k_tztx,
            "k_tzty": k_tzty,
            "k_tztz": k_tztz,
            "c_tilt": c_tilt,
            "c_x": c_x,
            "c_y": c_y,
            "c_z": c_z,
            "c_tilt_x": c_tilt_x,
            "c_tilt_y": c_tilt_y,
            "c_spin": c_spin,
            "c_xx": c_xx,
            "c_xy": c_xy,
            "c_xz": c_xz,
            "c_xtx": c_xtx,
            "c_xty": c_xty,
            "c_xtz": c_xtz,
            "c_yx": c_yx,
            "c_yy": c_yy,
            "c_yz": c_yz,
            "c_ytx": c_ytx,
            "c_yty": c_yty,
            "c_ytz": c_ytz,
            "c_zx": c_zx,
            "c_zy": c_zy,
            "c_zz": c_zz,
            "c_ztx": c_ztx,
            "c_zty": c_zty,
            "c_ztz": c_ztz,
            "c_txx": c_txx,
            "c_txy": c_txy,
            "c_txz": c_txz,
            "c_txtx": c_txtx,
            "c_txty": c_txty,
            "c_txtz": c_txtz,
            "c_tyx": c_tyx,
            "c_tyy": c_tyy,
            "c_tyz": c_tyz,
            "c_tytx": c_tytx,
            "c_tyty": c_tyty,
            "c_tytz": c_tytz,
            "c_tzx": c_tzx,
            "c_tzy": c_tzy,
            "c_tzz": c_tzz,
            "c_tztx": c_tztx,
            "c_tzty": c_tzty,
            "c_tztz": c_tztz,
            "stiffness_si": stiffness_si,
            "damping_si": damping_si,
        })


class Sensor(Part):
    """A point mass, such as an accelerometer or the added mass of a seal. ``[sensor.NAME]`` of the model file.

    ``at`` (name of a station, disc, body, housing or ground): Where it acts. Required.
    ``offset`` (length: three: x, y, z): Distance from there; on ground the position. Without it: "0, 0, 0 m".
    ``mass`` (mass: one, or three: x, y, z, zero or greater): Mass; by axis for the added mass of a seal or
        the like. Required.
    """

    _table = "sensor"

    def __init__(
        self,
        name: str,
        *,
        at: str | None = None,
        offset: str | Sequence[str] | None = None,
        mass: str | Sequence[str] | None = None,
    ) -> None:
        super().__init__(name, {
            "at": at,
            "offset": offset,
            "mass": mass,
        })


class Bushing(Part):
    """Springs and dampers between two places. ``[bushing.NAME]`` of the model file.

    ``between`` (names of two places): The two places that it connects. Required.
    ``point`` (length: three: x, y, z): Position of the connection. Without it: the first place that is not
        ground.
    ``unsymmetric`` (true or false): Whether unsymmetric matrices are accepted, which may bring in energy, as
        those of fluid films. Without it: false.
    ``lever_arms`` (true or false): Whether it acts at one point, with lever arms to both places; otherwise on
        their displacements, as a coupling without length. Without it: true.
    ``k_tilt`` (rotational stiffness: one, zero or greater): Both tilts, about x and about y. Without it: 0.
    ``k_x`` (stiffness: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``k_y`` (stiffness: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``k_z`` (stiffness: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``k_tilt_x`` (rotational stiffness: one, zero or greater): Translation along an axis, tilt about it, or
        spin about z. Without it: 0.
    ``k_tilt_y`` (rotational stiffness: one, zero or greater): Translation along an axis, tilt about it, or
        spin about z. Without it: 0.
    ``k_spin`` (rotational stiffness: one, zero or greater): Translation along an axis, tilt about it, or spin
        about z. Without it: 0.
    ``k_xx`` (stiffness: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``k_xy`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_xz`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_xtx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_xty`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_xtz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_yx`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_yy`` (stiffness: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``k_yz`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_ytx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_yty`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_ytz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_zx`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_zy`` (stiffness: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``k_zz`` (stiffness: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``k_ztx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_zty`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_ztz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txy`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txtx`` (rotational stiffness: one, zero or greater): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_txty`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_txtz`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tyx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tyy`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tyz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tytx`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tyty`` (rotational stiffness: one, zero or greater): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tytz`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tzx`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tzy`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tzz`` (stiffness between translation and tilt: one): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``k_tztx`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tzty`` (rotational stiffness: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``k_tztz`` (rotational stiffness: one, zero or greater): Force or moment of the first DOF per motion of
        the second. Without it: 0.
    ``c_tilt`` (rotational damping: one, zero or greater): Both tilts, about x and about y. Without it: 0.
    ``c_x`` (damping: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``c_y`` (damping: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``c_z`` (damping: one, zero or greater): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``c_tilt_x`` (rotational damping: one, zero or greater): Translation along an axis, tilt about it, or spin
        about z. Without it: 0.
    ``c_tilt_y`` (rotational damping: one, zero or greater): Translation along an axis, tilt about it, or spin
        about z. Without it: 0.
    ``c_spin`` (rotational damping: one, zero or greater): Translation along an axis, tilt about it, or spin
        about z. Without it: 0.
    ``c_xx`` (damping: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_xy`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_xz`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_xtx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_xty`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_xtz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_yx`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_yy`` (damping: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_yz`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_ytx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_yty`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_ytz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_zx`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_zy`` (damping: one): Force or moment of the first DOF per motion of the second. Without it: 0.
    ``c_zz`` (damping: one, zero or greater): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_ztx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_zty`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_ztz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txy`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txtx`` (rotational damping: one, zero or greater): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_txty`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_txtz`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tyx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tyy`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tyz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tytx`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tyty`` (rotational damping: one, zero or greater): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tytz`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tzx`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tzy`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tzz`` (damping between translation and tilt: one): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``c_tztx`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tzty`` (rotational damping: one): Force or moment of the first DOF per motion of the second. Without
        it: 0.
    ``c_tztz`` (rotational damping: one, zero or greater): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``stiffness_si`` (number: 6 x 6 in SI units): Whole matrix, rows and columns u_x u_y u_z theta_x theta_y
        theta_z. Without it: from its components.
    ``damping_si`` (number: 6 x 6 in SI units): Whole matrix, rows and columns u_x u_y u_z theta_x theta_y
        theta_z. Without it: from its components.
    """

    _table = "bushing"

    def __init__(
        self,
        name: str,
        *,
        between: str | Sequence[str] | None = None,
        point: str | Sequence[str] | None = None,
        unsymmetric: bool | None = None,
        lever_arms: bool | None = None,
        k_tilt: str | Sequence[str] | None = None,
        k_x: str | Sequence[str] | None = None,
        k_y: str | Sequence[str] | None = None,
        k_z: str | Sequence[str] | None = None,
        k_tilt_x: str | Sequence[str] | None = None,
        k_tilt_y: str | Sequence[str] | None = None,
        k_spin: str | Sequence[str] | None = None,
        k_xx: str | Sequence[str] | None = None,
        k_xy: str | Sequence[str] | None = None,
        k_xz: str | Sequence[str] | None = None,
        k_xtx: str | Sequence[str] | None = None,
        k_xty: str | Sequence[str] | None = None,
        k_xtz: str | Sequence[str] | None = None,
        k_yx: str | Sequence[str] | None = None,
        k_yy: str | Sequence[str] | None = None,
        k_yz: str | Sequence[str] | None = None,
        k_ytx: str | Sequence[str] | None = None,
        k_yty: str | Sequence[str] | None = None,
        k_ytz: str | Sequence[str] | None = None,
        k_zx: str | Sequence[str] | None = None,
        k_zy: str | Sequence[str] | None = None,
        k_zz: str | Sequence[str] | None = None,
        k_ztx: str | Sequence[str] | None = None,
        k_zty: str | Sequence[str] | None = None,
        k_ztz: str | Sequence[str] | None = None,
        k_txx: str | Sequence[str] | None = None,
        k_txy: str | Sequence[str] | None = None,
        k_txz: str | Sequence[str] | None = None,
        k_txtx: str | Sequence[str] | None = None,
        k_txty: str | Sequence[str] | None = None,
        k_txtz: str | Sequence[str] | None = None,
        k_tyx: str | Sequence[str] | None = None,
        k_tyy: str | Sequence[str] | None = None,
        k_tyz: str | Sequence[str] | None = None,
        k_tytx: str | Sequence[str] | None = None,
        k_tyty: str | Sequence[str] | None = None,
        k_tytz: str | Sequence[str] | None = None,
        k_tzx: str | Sequence[str] | None = None,
        k_tzy: str | Sequence[str] | None = None,
        k_tzz: str | Sequence[str] | None = None,
        k_tztx: str | Sequence[str] | None = None,
        k_tzty: str | Sequence[str] | None = None,
        k_tztz: str | Sequence[str] | None = None,
        c_tilt: str | Sequence[str] | None = None,
        c_x: str | Sequence[str] | None = None,
        c_y: str | Sequence[str] | None = None,
        c_z: str | Sequence[str] | None = None,
        c_tilt_x: str | Sequence[str] | None = None,
        c_tilt_y: str | Sequence[str] | None = None,
        c_spin: str | Sequence[str] | None = None,
        c_xx: str | Sequence[str] | None = None,
        c_xy: str | Sequence[str] | None = None,
        c_xz: str | Sequence[str] | None = None,
        c_xtx: str | Sequence[str] | None = None,
        c_xty: str | Sequence[str] | None = None,
        c_xtz: str | Sequence[str] | None = None,
        c_yx: str | Sequence[str] | None = None,
        c_yy: str | Sequence[str] | None = None,
        c_yz: str | Sequence[str] | None = None,
        c_ytx: str | Sequence[str] | None = None,
        c_yty: str | Sequence[str] | None = None,
        c_ytz: str | Sequence[str] | None = None,
        c_zx: str | Sequence[str] | None = None,
        c_zy: str | Sequence[str] | None = None,
        c_zz: str | Sequence[str] | None = None,
        c_ztx: str | Sequence[str] | None = None,
        c_zty: str | Sequence[str] | None = None,
        c_ztz: str | Sequence[str] | None = None,
        c_txx: str | Sequence[str] | None = None,
        c_txy: str | Sequence[str] | None = None,
        c_txz: str | Sequence[str] | None = None,
        c_txtx: str | Sequence[str] | None = None,
        c_txty: str | Sequence[str] | None = None,
        c_txtz: str | Sequence[str] | None = None,
        c_tyx: str | Sequence[str] | None = None,
        c_tyy: str | Sequence[str] | None = None,
        c_tyz: str | Sequence[str] | None = None,
        c_tytx: str | Sequence[str] | None = None,
        c_tyty: str | Sequence[str] | None = None,
        c_tytz: str | Sequence[str] | None = None,
        c_tzx: str | Sequence[str] | None = None,
        c_tzy: str | Sequence[str] | None = None,
        c_tzz: str | Sequence[str] | None = None,
        c_tztx: str | Sequence[str] | None = None,
        c_tzty: str | Sequence[str] | None = None,
        c_tztz: str | Sequence[str] | None = None,
        stiffness_si: float | Sequence[float] | str | None = None,
        damping_si: float | Sequence[float] | str | None = None,
    ) -> None:
        super().__init__(name, {
            "between": between,
            "point": point,
            "unsymmetric": unsymmetric,
            "lever_arms": lever_arms,
            "k_tilt": k_tilt,
            "k_x": k_x,
            "k_y": k_y,
            "k_z": k_z,
            "k_tilt_x": k_tilt_x,
            "k_tilt_y": k_tilt_y,
            "k_spin": k_spin,
            "k_xx": k_xx,
            "k_xy": k_xy,
            "k_xz": k_xz,
            "k_xtx": k_xtx,
            "k_xty": k_xty,
            "k_xtz": k_xtz,
            "k_yx": k_yx,
            "k_yy": k_yy,
            "k_yz": k_yz,
            "k_ytx": k_ytx,
            "k_yty": k_yty,
            "k_ytz": k_ytz,
            "k_zx": k_zx,
            "k_zy": k_zy,
            "k_zz": k_zz,
            "k_ztx": k_ztx,
            "k_zty": k_zty,
            "k_ztz": k_ztz,
            "k_txx": k_txx,
            "k_txy": k_txy,
            "k_txz": k_txz,
            "k_txtx": k_txtx,
            "k_txty": k_txty,
            "k_txtz": k_txtz,
            "k_tyx": k_tyx,
            "k_tyy": k_tyy,
            "k_tyz": k_tyz,
            "k_tytx": k_tytx,
            "k_tyty": k_tyty,
            "k_tytz": k_tytz,
            "k_tzx": k_tzx,
            "k_tzy": k_tzy,
            "k_tzz": k_tzz,
            "k_tztx": k_tztx,
            "k_tzty": k_tzty,
            "k_tztz": k_tztz,
            "c_tilt": c_tilt,
            "c_x": c_x,
            "c_y": c_y,
            "c_z": c_z,
            "c_tilt_x": c_tilt_x,
            "c_tilt_y": c_tilt_y,
            "c_spin": c_spin,
            "c_xx": c_xx,
            "c_xy": c_xy,
            "c_xz": c_xz,
            "c_xtx": c_xtx,
            "c_xty": c_xty,
            "c_xtz": c_xtz,
            "c_yx": c_yx,
            "c_yy": c_yy,
            "c_yz": c_yz,
            "c_ytx": c_ytx,
            "c_yty": c_yty,
            "c_ytz": c_ytz,
            "c_zx": c_zx,
            "c_zy": c_zy,
            "c_zz": c_zz,
            "c_ztx": c_ztx,
            "c_zty": c_zty,
            "c_ztz": c_ztz,
            "c_txx": c_txx,
            "c_txy": c_txy,
            "c_txz": c_txz,
            "c_txtx": c_txtx,
            "c_txty": c_txty,
            "c_txtz": c_txtz,
            "c_tyx": c_tyx,
            "c_tyy": c_tyy,
            "c_tyz": c_tyz,
            "c_tytx": c_tytx,
            "c_tyty": c_tyty,
            "c_tytz": c_tytz,
            "c_tzx": c_tzx,
            "c_tzy": c_tzy,
            "c_tzz": c_tzz,
            "c_tztx": c_tztx,
            "c_tzty": c_tzty,
            "c_tztz": c_tztz,
            "stiffness_si": stiffness_si,
            "damping_si": damping_si,
        })


class Joint(Part):
    """An exact constraint between two places. ``[joint.NAME]`` of the model file.

    ``between`` (names of two places): The two places that it connects. Required.
    ``point`` (length: three: x, y, z): Position of the connection. Without it: the first place that is not
        ground.
    ``kind`` ("spherical", "cylindrical", "revolute", "fixed"): Constrained DOFs by the kind of joint. Without
        it: required, or constrain.
    ``axial`` ("fixed", "free"): Overrides the constraint along z, of any kind. Without it: by kind. With kind
        = "spherical".
    ``constrain`` (some of x, y, z, tx, ty, tz): Constrained DOFs one by one. Without it: required, or kind.
    """

    _table = "joint"

    def __init__(
        self,
        name: str,
        *,
        between: str | Sequence[str] | None = None,
        point: str | Sequence[str] | None = None,
        kind: Literal["spherical", "cylindrical", "revolute", "fixed"] | None = None,
        axial: Literal["fixed", "free"] | None = None,
        constrain: str | Sequence[str] | None = None,
    ) -> None:
        super().__init__(name, {
            "between": between,
            "point": point,
            "kind": kind,
            "axial": axial,
            "constrain": constrain,
        })


class Belt(Part):
    """A belt on the shaft, to ground. ``[belt.NAME]`` of the model file.

    ``station`` (name of a station): Where it runs. Required.
    ``pull`` (force: two: x, y): Static force on the shaft. Without it: "0, 0 N".
    ``constant_pull`` (true or false): Pull is that of the machine at rest; otherwise of the undeflected
        shaft. Without it: false.
    ``k_x`` (stiffness, zero or greater): Stiffness along x. Without it: "0 N/m".
    ``k_y`` (stiffness, zero or greater): Stiffness along y. Without it: "0 N/m".
    ``k_spin`` (rotational stiffness, zero or greater): Stiffness of rotation about z. Without it: "0 N
        m/rad".
    ``c_x`` (damping, zero or greater): Damping along x. Without it: "0 N s/m".
    ``c_y`` (damping, zero or greater): Damping along y. Without it: "0 N s/m".
    ``c_spin`` (rotational damping, zero or greater): Damping of rotation about z. Without it: "0 N m s/rad".
    """

    _table = "belt"

    def __init__(
        self,
        name: str,
        *,
        station: str | None = None,
        pull: str | Sequence[str] | None = None,
        constant_pull: bool | None = None,
        k_x: str | None = None,
        k_y: str | None = None,
        k_spin: str | None = None,
        c_x: str | None = None,
        c_y: str | None = None,
        c_spin: str | None = None,
    ) -> None:
        super().__init__(name, {
            "station": station,
            "pull": pull,
            "constant_pull": constant_pull,
            "k_x": k_x,
            "k_y": k_y,
            "k_spin": k_spin,
            "c_x": c_x,
            "c_y": c_y,
            "c_spin": c_spin,
        })


class BallBearing(Part):
    """A bearing between the shaft and a housing, a body or ground. ``[bearing.NAME]`` of the model file with
    ``model = "ball"``.

    ``station`` (name of a station): Where it sits on the shaft; not in a file with bearings only. Required.
    ``housing`` (ground or name of a housing or body): What holds its outer ring. Without it: "ground".
    ``designation`` (a designation of the catalogue): Bearing of the built-in catalogue; keys override it.
    ``balls`` (whole number, from 3 to 1000): Number of balls. Without it: required, without designation.
    ``ball_diameter`` (length, greater than zero): Diameter D_w of the balls. Without it: required, without
        designation.
    ``pitch_diameter`` (length, greater than zero): Diameter D_pw of the circle through the ball centres.
        Without it: required, without designation.
    ``inner_osculation`` (number, greater than zero): Radius of the inner groove over the ball diameter.
        Without it: required, without designation.
    ``outer_osculation`` (number, greater than zero): Radius of the outer groove over the ball diameter.
        Without it: required, without designation.
    ``inner_groove_radius`` (length, greater than zero): Radius of the inner groove, instead of its
        osculation. Without it: from inner_osculation.
    ``outer_groove_radius`` (length, greater than zero): Radius of the outer groove, instead of its
        osculation. Without it: from outer_osculation.
    ``radial_clearance`` (length): Radial internal clearance, diametral; negative: preload. Without it: by
        clearance, with a contact angle 0.
    ``clearance`` ("C2", "CN", "C3", "C4", "C5"): Clearance class of ISO 5753-1, instead of radial_clearance.
        Without it: "CN".
    ``bore`` (length, greater than zero): Bore of the inner ring. Without it: of the designation, else D_pw -
        2.2 D_w.
    ``outside_diameter`` (length, greater than zero): Outside diameter of the outer ring. Without it: of the
        designation, else D_pw + 2.2 D_w.
    ``width`` (length, greater than zero): Width of the rings. Without it: of the designation, else 1.8 D_w.
    ``material`` (name of a material): Material of balls and rings. Without it: bearing steel.
    ``ball_material`` (name of a material): Material of the balls. Without it: material.
    ``ring_material`` (name of a material): Material of the rings. Without it: material.
    ``cage`` ("rolling" or number, from 0 to 1): Cage speed of balls that roll without slip. Cage speed over
        shaft speed. Without it: "rolling".
    ``cage_angle`` (angle): Position of a ball at the start of a run, from +x towards +y. Without it: "0 deg".
    ``cage_pocket_diameter`` (length, greater than zero): Diameter of the cage pockets. Without it: from the
        geometry.
    ``contact_angle`` (angle, zero or greater): Nominal contact angle, below 90 deg. Without it: of the
        designation, else 0 deg.
    ``thrust`` ("+z", "-z"): Direction of the shaft's axial load that the bearing transmits to the housing.
        Without it: required, with a contact angle or preload.
    ``moment_arm`` (length, greater than zero): Radius at which axial ball forces act. Without it: that of the
        inner groove centres.
    ``ball_inertia`` ("auto", "none", "outer_race_control", "inner_race_control", "harris_inner_race_control",
        "shared", "centrifugal" or table): Centrifugal force and gyroscopic moment of the balls, and the race
        that takes the moment. A constant force of every ball at any speed, without moment. Without it:
        "auto".
    ``contact`` ("hertz", "film", "power_law", "ehl"): Dry contact, with the film thickness of Hamrock and
        Dowson, fitted, or with a solved film. Without it: "hertz".
    ``speed_factor`` (number, greater than zero): Factor of the entrainment speed, of the contacts film and
        ehl. Without it: 1. With contact = "film".
    ``power_law`` (table): A fitted law of both contacts in series, F = K d^n + offset. Without it: required,
        with contact = "power_law". With contact = "power_law".
    ``ehl`` (table): Range and resolution of the tables of the solved film. With contact = "ehl".
    ``contact_damping`` (damping, zero or greater): Damping of a loaded contact; or one of the next two.
        Without it: "300 N s/m".
    ``damping_ramp`` (length, greater than zero): Deflection over which this damping sets in. Without it: "1
        um".
    ``hunt_crossley`` (damping per speed of approach, zero or greater): Damping by Hunt and Crossley.
    ``film_damping`` (number, greater than zero): Damping by the film, factor of its relaxation time, about 1;
        of the contacts film and ehl. With contact = "film".
    ``contact_stiffness`` (stiffness in N/m^1.5 or table): Stiffness of both contacts in series, instead of
        Hertz. Stiffness of each contact, instead of Hertz. Without it: Hertz.
    ``lubricant`` (name of a lubricant): Oil of the film, of the friction torque and of the rating life.
        Without it: the only one of the file, for a film.
    ``preload`` (table): Axial preload in the direction of thrust, in one of five forms; rows in tandem share
        it.
    ``fit`` (table): Fits of the rings, their temperatures and growth, which change the clearance.
    ``arrangement`` ("back_to_back", "face_to_face", "tandem"): Duplex pair of angular contact bearings.
    ``row_spacing`` (length, greater than zero): Distance of the two rows, of a pair in any arrangement.
        Without it: required, with arrangement. With arrangement = "back_to_back".
    ``inner_waviness`` (list of tables or table): A harmonic of waviness. Waviness as a spectrum over the
        order n, with random phases.
    ``outer_waviness`` (list of tables or table): A harmonic of waviness. Waviness as a spectrum over the
        order n, with random phases.
    ``ball_waviness`` (list of tables or table): A harmonic of waviness of the balls. Waviness of the balls as
        a spectrum over the order n, with random phases.
    ``off_size`` (list of tables): A ball of another size.
    ``inner_eccentricity`` (table): Eccentricity of a race.
    ``outer_eccentricity`` (table): Eccentricity of a race.
    ``ball_spin`` ("rolling", "shaft"): Spin of the balls with their imperfections: that of rolling, or the
        speed of the shaft. Without it: "rolling".
    ``defect`` (list of tables): A local defect of a race or a ball.
    ``defect_law`` ("displacement", "undamped_displacement", "force", "force_on_loaded"): How a defect acts;
        all but displacement are those of Atef et al. (2022). Without it: "displacement".
    ``defect_stiffness`` (stiffness in N/m^1.5): Contact stiffness of the laws force and force_on_loaded.
        Without it: that of the contacts. With defect_law = "force" or model = "free_ball", defect_law =
        "force".
    ``lubrication`` ("oil_bath", "oil_mist", "oil_jet", "grease" or table): Lubrication with a lubricant or
        film, for the friction torque; oil_jet is also an oil bath with a vertical shaft. Factor of the
        viscous part of the friction torque with a lubricant or film, instead of a method. Without it:
        "oil_bath". With lubricant = "oil" or model = "free_ball", lubricant = "oil".
    ``sliding_friction`` (number, from 0 to 1): Coefficient of friction of spinning balls. Without it: 0.06.
    ``dynamic_rating`` (force, greater than zero): Basic dynamic load rating C. Without it: from the geometry.
    ``static_rating`` (force, greater than zero): Basic static load rating C_0. Without it: from the geometry.
    ``fatigue_limit`` (force, greater than zero): Fatigue load limit C_u. Without it: from the geometry.
    ``contamination`` (number, from 0 to 1): Contamination factor e_C of ISO 281. Without it: 0.5.
    ``reliability`` (number, from 0.9 to 0.999): Reliability of the rating life. Without it: 0.9.
    ``inner_shoulder_diameter`` (length, greater than zero): Diameter of the inner shoulder. Without it: 0.2
        D_w high; with a contact angle at least 25 deg beyond it.
    ``outer_shoulder_diameter`` (length, greater than zero): Diameter of the outer shoulder. Without it: 0.2
        D_w high; with a contact angle at least 25 deg beyond it.
    """

    _table = "bearing"
    _fixed = {"model": "ball"}

    def __init__(
        self,
        name: str,
        *,
        station: str | None = None,
        housing: str | None = None,
        designation: str | None = None,
        balls: int | None = None,
        ball_diameter: str | None = None,
        pitch_diameter: str | None = None,
        inner_osculation: float | None = None,
        outer_osculation: float | None = None,
        inner_groove_radius: str | None = None,
        outer_groove_radius: str | None = None,
        radial_clearance: str | None = None,
        clearance: Literal["C2", "CN", "C3", "C4", "C5"] | None = None,
        bore: str | None = None,
        outside_diameter: str | None = None,
        width: str | None = None,
        material: str | None = None,
        ball_material: str | None = None,
        ring_material: str | None = None,
        cage: Literal["rolling"] | float | None = None,
        cage_angle: str | None = None,
        cage_pocket_diameter: str | None = None,
        contact_angle: str | None = None,
        thrust: Literal["+z", "-z"] | None = None,
        moment_arm: str | None = None,
        ball_inertia: Literal["auto", "none", "outer_race_control", "inner_race_control", "harris_inner_race_control", "shared", "centrifugal"] | Mapping[str, Any] | None = None,
        contact: Literal["hertz", "film", "power_law", "ehl"] | None = None,
        speed_factor: float | None = None,
        power_law: Mapping[str, Any] | None = None,
        ehl: Mapping[str, Any] | None = None,
        contact_damping: str | None = None,
        damping_ramp: str | None = None,
        hunt_crossley: str | None = None,
        film_damping: float | None = None,
        contact_stiffness: str | Mapping[str, Any] | None = None,
        lubricant: str | None = None,
        preload: Mapping[str, Any] | None = None,
        fit: Mapping[str, Any] | None = None,
        arrangement: Literal["back_to_back", "face_to_face", "tandem"] | None = None,
        row_spacing: str | None = None,
        inner_waviness: Sequence[Mapping[str, Any]] | Mapping[str, Any] | None = None,
        outer_waviness: Sequence[Mapping[str, Any]] | Mapping[str, Any] | None = None,
        ball_waviness: Sequence[Mapping[str, Any]] | Mapping[str, Any] | None = None,
        off_size: Sequence[Mapping[str, Any]] | None = None,
        inner_eccentricity: Mapping[str, Any] | None = None,
        outer_eccentricity: Mapping[str, Any] | None = None,
        ball_spin: Literal["rolling", "shaft"] | None = None,
        defect: Sequence[Mapping[str, Any]] | None = None,
        defect_law: Literal["displacement", "undamped_displacement", "force", "force_on_loaded"] | None = None,
        defect_stiffness: str | None = None,
        lubrication: Literal["oil_bath", "oil_mist", "oil_jet", "grease"] | Mapping[str, Any] | None = None,
        sliding_friction: float | None = None,
        dynamic_rating: str | None = None,
        static_rating: str | None = None,
        fatigue_limit: str | None = None,
        contamination: float | None = None,
        reliability: float | None = None,
        inner_shoulder_diameter: str | None = None,
        outer_shoulder_diameter: str | None = None,
    ) -> None:
        super().__init__(name, {
            "station": station,
            "housing": housing,
            "designation": designation,
            "balls": balls,
            "ball_diameter": ball_diameter,
            "pitch_diameter": pitch_diameter,
            "inner_osculation": inner_osculation,
            "outer_osculation": outer_osculation,
            "inner_groove_radius": inner_groove_radius,
            "outer_groove_radius": outer_groove_radius,
            "radial_clearance": radial_clearance,
            "clearance": clearance,
            "bore": bore,
            "outside_diameter": outside_diameter,
            "width": width,
            "material": material,
            "ball_material": ball_material,
            "ring_material": ring_material,
            "cage": cage,
            "cage_angle": cage_angle,
            "cage_pocket_diameter": cage_pocket_diameter,
            "contact_angle": contact_angle,
            "thrust": thrust,
            "moment_arm": moment_arm,
            "ball_inertia": ball_inertia,
            "contact": contact,
            "speed_factor": speed_factor,
            "power_law": power_law,
            "ehl": ehl,
            "contact_damping": contact_damping,
            "damping_ramp": damping_ramp,
            "hunt_crossley": hunt_crossley,
            "film_damping": film_damping,
            "contact_stiffness": contact_stiffness,
            "lubricant": lubricant,
            "preload": preload,
            "fit": fit,
            "arrangement": arrangement,
            "row_spacing": row_spacing,
            "inner_waviness": inner_waviness,
            "outer_waviness": outer_waviness,
            "ball_waviness": ball_waviness,
            "off_size": off_size,
            "inner_eccentricity": inner_eccentricity,
            "outer_eccentricity": outer_eccentricity,
            "ball_spin": ball_spin,
            "defect": defect,
            "defect_law": defect_law,
            "defect_stiffness": defect_stiffness,
            "lubrication": lubrication,
            "sliding_friction": sliding_friction,
            "dynamic_rating": dynamic_rating,
            "static_rating": static_rating,
            "fatigue_limit": fatigue_limit,
            "contamination": contamination,
            "reliability": reliability,
            "inner_shoulder_diameter": inner_shoulder_diameter,
            "outer_shoulder_diameter": outer_shoulder_diameter,
        })


class RadialBallBearing(Part):
    """A bearing between the shaft and a housing, a body or ground. ``[bearing.NAME]`` of the model file with
    ``model = "radial_ball"``.

    ``station`` (name of a station): Where it sits on the shaft; not in a file with bearings only. Required.
    ``housing`` (ground or name of a housing or body): What holds its outer ring. Without it: "ground".
    ``designation`` (a designation of the catalogue): Bearing of the built-in catalogue; keys override it.
    ``balls`` (whole number, from 3 to 1000): Number of balls. Without it: required, without designation.
    ``ball_diameter`` (length, greater than zero): Diameter D_w of the balls. Without it: required, without
        designation.
    ``pitch_diameter`` (length, greater than zero): Diameter D_pw of the circle through the ball centres.
        Without it: required, without designation.
    ``inner_osculation`` (number, greater than zero): Radius of the inner groove over the ball diameter.
        Without it: required, without designation.
    ``outer_osculation`` (number, greater than zero): Radius of the outer groove over the ball diameter.
        Without it: required, without designation.
    ``inner_groove_radius`` (length, greater than zero): Radius of the inner groove, instead of its
        osculation. Without it: from inner_osculation.
    ``outer_groove_radius`` (length, greater than zero): Radius of the outer groove, instead of its
        osculation. Without it: from outer_osculation.
    ``radial_clearance`` (length): Radial internal clearance, diametral; negative: preload. Without it: by
        clearance, with a contact angle 0.
    ``clearance`` ("C2", "CN", "C3", "C4", "C5"): Clearance class of ISO 5753-1, instead of radial_clearance.
        Without it: "CN".
    ``bore`` (length, greater than zero): Bore of the inner ring. Without it: of the designation, else D_pw -
        2.2 D_w.
    ``outside_diameter`` (length, greater than zero): Outside diameter of the outer ring. Without it: of the
        designation, else D_pw + 2.2 D_w.
    ``width`` (length, greater than zero): Width of the rings. Without it: of the designation, else 1.8 D_w.
    ``material`` (name of a material): Material of balls and rings. Without it: bearing steel.
    ``ball_material`` (name of a material): Material of the balls. Without it: material.
    ``ring_material`` (name of a material): Material of the rings. Without it: material.
    ``cage`` ("rolling" or number, from 0 to 1): Cage speed of balls that roll without slip. Cage speed over
        shaft speed. Without it: "rolling".
    ``cage_angle`` (angle): Position of a ball at the start of a run, from +x towards +y. Without it: "0 deg".
    ``cage_pocket_diameter`` (length, greater than zero): Diameter of the cage pockets. Without it: from the
        geometry.
    ``contact_stiffness`` (stiffness in N/m^1.5 or table): Stiffness of both contacts in series, instead of
        Hertz. Stiffness of each contact, instead of Hertz. Without it: Hertz.
    ``inner_waviness`` (list of tables or table): A harmonic of waviness. Waviness as a spectrum over the
        order n, with random phases.
    ``outer_waviness`` (list of tables or table): A harmonic of waviness. Waviness as a spectrum over the
        order n, with random phases.
    ``ball_waviness`` (list of tables or table): A harmonic of waviness of the balls. Waviness of the balls as
        a spectrum over the order n, with random phases.
    ``off_size`` (list of tables): A ball of another size.
    ``inner_eccentricity`` (table): Eccentricity of a race.
    ``outer_eccentricity`` (table): Eccentricity of a race.
    ``ball_spin`` ("rolling", "shaft"): Spin of the balls with their imperfections: that of rolling, or the
        speed of the shaft. Without it: "rolling".
    ``defect`` (list of tables): A local defect of a race or a ball.
    ``stiffness_damping`` (time, zero or greater or table): Stiffness-proportional damping of both contacts,
        factor of the contact stiffness. Stiffness-proportional damping of each contact. Required.
    ``tensile_contact`` (true or false): Whether the damped force may pull while contacts separate (Upadhyay
        et al. 2009). Without it: false.
    """

    _table = "bearing"
    _fixed = {"model": "radial_ball"}

    def __init__(
        self,
        name: str,
        *,
        station: str | None = None,
        housing: str | None = None,
        designation: str | None = None,
        balls: int | None = None,
        ball_diameter: str | None = None,
        pitch_diameter: str | None = None,
        inner_osculation: float | None = None,
        outer_osculation: float | None = None,
        inner_groove_radius: str | None = None,
        outer_groove_radius: str | None = None,
        radial_clearance: str | None = None,
        clearance: Literal["C2", "CN", "C3", "C4", "C5"] | None = None,
        bore: str | None = None,
        outside_diameter: str | None = None,
        width: str | None = None,
        material: str | None = None,
        ball_material: str | None = None,
        ring_material: str | None = None,
        cage: Literal["rolling"] | float | None = None,
        cage_angle: str | None = None,
        cage_pocket_diameter: str | None = None,
        contact_stiffness: str | Mapping[str, Any] | None = None,
        inner_waviness: Sequence[Mapping[str, Any]] | Mapping[str, Any] | None = None,
        outer_waviness: Sequence[Mapping[str, Any]] | Mapping[str, Any] | None = None,
        ball_waviness: Sequence[Mapping[str, Any]] | Mapping[str, Any] | None = None,
        off_size: Sequence[Mapping[str, Any]] | None = None,
        inner_eccentricity: Mapping[str, Any] | None = None,
        outer_eccentricity: Mapping[str, Any] | None = None,
        ball_spin: Literal["rolling", "shaft"] | None = None,
        defect: Sequence[Mapping[str, Any]] | None = None,
        stiffness_damping: str | Mapping[str, Any] | None = None,
        tensile_contact: bool | None = None,
    ) -> None:
        super().__init__(name, {
            "station": station,
            "housing": housing,
            "designation": designation,
            "balls": balls,
            "ball_diameter": ball_diameter,
            "pitch_diameter": pitch_diameter,
            "inner_osculation": inner_osculation,
            "outer_osculation": outer_osculation,
            "inner_groove_radius": inner_groove_radius,
            "outer_groove_radius": outer_groove_radius,
            "radial_clearance": radial_clearance,
            "clearance": clearance,
            "bore": bore,
            "outside_diameter": outside_diameter,
            "width": width,
            "material": material,
            "ball_material": ball_material,
            "ring_material": ring_material,
            "cage": cage,
            "cage_angle": cage_angle,
            "cage_pocket_diameter": cage_pocket_diameter,
            "contact_stiffness": contact_stiffness,
            "inner_waviness": inner_waviness,
            "outer_waviness": outer_waviness,
            "ball_waviness": ball_waviness,
            "off_size": off_size,
            "inner_eccentricity": inner_eccentricity,
            "outer_eccentricity": outer_eccentricity,
            "ball_spin": ball_spin,
            "defect": defect,
            "stiffness_damping": stiffness_damping,
            "tensile_contact": tensile_contact,
        })


class FreeBallBearing(Part):
    """A bearing between the shaft and a housing, a body or ground. ``[bearing.NAME]`` of the model file with
    ``model = "free_ball"``.

    ``station`` (name of a station): Where it sits on the shaft; not in a file with bearings only. Required.
    ``housing`` (ground or name of a housing or body): What holds its outer ring. Without it: "ground".
    ``designation`` (a designation of the catalogue): Bearing of the built-in catalogue; keys override it.
    ``balls`` (whole number, from 3 to 1000): Number of balls. Without it: required, without designation.
    ``ball_diameter`` (length, greater than zero): Diameter D_w of the balls. Without it: required, without
        designation.
    ``pitch_diameter`` (length, greater than zero): Diameter D_pw of the circle through the ball centres.
        Without it: required, without designation.
    ``inner_osculation`` (number, greater than zero): Radius of the inner groove over the ball diameter.
        Without it: required, without designation.
    ``outer_osculation`` (number, greater than zero): Radius of the outer groove over the ball diameter.
        Without it: required, without designation.
    ``inner_groove_radius`` (length, greater than zero): Radius of the inner groove, instead of its
        osculation. Without it: from inner_osculation.
    ``outer_groove_radius`` (length, greater than zero): Radius of the outer groove, instead of its
        osculation. Without it: from outer_osculation.
    ``radial_clearance`` (length): Radial internal clearance, diametral; negative: preload. Without it: by
        clearance, with a contact angle 0.
    ``clearance`` ("C2", "CN", "C3", "C4", "C5"): Clearance class of ISO 5753-1, instead of radial_clearance.
        Without it: "CN".
    ``bore`` (length, greater than zero): Bore of the inner ring. Without it: of the designation, else D_pw -
        2.2 D_w.
    ``outside_diameter`` (length, greater than zero): Outside diameter of the outer ring. Without it: of the
        designation, else D_pw + 2.2 D_w.
    ``width`` (length, greater than zero): Width of the rings. Without it: of the designation, else 1.8 D_w.
    ``material`` (name of a material): Material of balls and rings. Without it: bearing steel.
    ``ball_material`` (name of a material): Material of the balls. Without it: material.
    ``ring_material`` (name of a material): Material of the rings. Without it: material.
    ``cage`` ("rolling" or number, from 0 to 1): Cage speed of balls that roll without slip. Cage speed over
        shaft speed. Without it: "rolling".
    ``cage_angle`` (angle): Position of a ball at the start of a run, from +x towards +y. Without it: "0 deg".
    ``cage_pocket_diameter`` (length, greater than zero): Diameter of the cage pockets. Without it: from the
        geometry.
    ``contact_angle`` (angle, zero or greater): Nominal contact angle, below 90 deg. Without it: of the
        designation, else 0 deg.
    ``thrust`` ("+z", "-z"): Direction of the shaft's axial load that the bearing transmits to the housing.
        Without it: required, with a contact angle or preload.
    ``moment_arm`` (length, greater than zero): Radius at which axial ball forces act. Without it: that of the
        inner groove centres.
    ``ball_inertia`` ("auto", "none", "outer_race_control", "inner_race_control", "harris_inner_race_control",
        "shared", "centrifugal" or table): Centrifugal force and gyroscopic moment of the balls, and the race
        that takes the moment. A constant force of every ball at any speed, without moment. Without it:
        "auto".
    ``contact_stiffness`` (stiffness in N/m^1.5 or table): Stiffness of both contacts in series, instead of
        Hertz. Stiffness of each contact, instead of Hertz. Without it: Hertz.
    ``lubricant`` (name of a lubricant): Oil of the film, of the friction torque and of the rating life.
        Without it: the only one of the file, for a film.
    ``preload`` (table): Axial preload in the direction of thrust, in one of five forms; rows in tandem share
        it.
    ``fit`` (table): Fits of the rings, their temperatures and growth, which change the clearance.
    ``inner_waviness`` (list of tables or table): A harmonic of waviness. Waviness as a spectrum over the
        order n, with random phases.
    ``outer_waviness`` (list of tables or table): A harmonic of waviness. Waviness as a spectrum over the
        order n, with random phases.
    ``ball_waviness`` (list of tables or table): A harmonic of waviness of the balls. Waviness of the balls as
        a spectrum over the order n, with random phases.
    ``off_size`` (list of tables): A ball of another size.
    ``inner_eccentricity`` (table): Eccentricity of a race.
    ``outer_eccentricity`` (table): Eccentricity of a race.
    ``ball_spin`` ("rolling", "shaft"): Spin of the balls with their imperfections: that of rolling, or the
        speed of the shaft. Without it: "rolling".
    ``defect`` (list of tables): A local defect of a race or a ball.
    ``defect_law`` ("displacement", "undamped_displacement", "force", "force_on_loaded"): How a defect acts;
        all but displacement are those of Atef et al. (2022). Without it: "displacement".
    ``defect_stiffness`` (stiffness in N/m^1.5): Contact stiffness of the laws force and force_on_loaded.
        Without it: that of the contacts. With defect_law = "force" or model = "ball", defect_law = "force".
    ``lubrication`` ("oil_bath", "oil_mist", "oil_jet", "grease" or table): Lubrication with a lubricant or
        film, for the friction torque; oil_jet is also an oil bath with a vertical shaft. Factor of the
        viscous part of the friction torque with a lubricant or film, instead of a method. Without it:
        "oil_bath". With lubricant = "oil" or model = "ball", lubricant = "oil".
    ``sliding_friction`` (number, from 0 to 1): Coefficient of friction of spinning balls. Without it: 0.06.
    ``dynamic_rating`` (force, greater than zero): Basic dynamic load rating C. Without it: from the geometry.
    ``static_rating`` (force, greater than zero): Basic static load rating C_0. Without it: from the geometry.
    ``fatigue_limit`` (force, greater than zero): Fatigue load limit C_u. Without it: from the geometry.
    ``contamination`` (number, from 0 to 1): Contamination factor e_C of ISO 281. Without it: 0.5.
    ``reliability`` (number, from 0.9 to 0.999): Reliability of the rating life. Without it: 0.9.
    ``inner_shoulder_diameter`` (length, greater than zero): Diameter of the inner shoulder. Without it: 0.2
        D_w high; with a contact angle at least 25 deg beyond it.
    ``outer_shoulder_diameter`` (length, greater than zero): Diameter of the outer shoulder. Without it: 0.2
        D_w high; with a contact angle at least 25 deg beyond it.
    ``friction_law`` ("coulomb", "curve", "film"): Friction of balls and races: Coulomb regularised at a slip
        speed, a traction curve, or the shear of the oil film. Without it: "coulomb".
    ``friction`` (number, zero or greater): Coefficient of friction of balls and races; with film the limit of
        its shear stress over pressure. Without it: 0.06.
    ``slip_speed`` (velocity, greater than zero): Slip up to which friction is proportional to slip; the time
        step shrinks with it. Without it: "20 mm/s".
    ``traction_curve`` (table): Friction over slip v, mu = D (1 - exp(-C v)) + B v exp(-C v) (Gupta 1984).
        Without it: required, with friction_law = "curve". With friction_law = "curve".
    ``eyring_stress`` (pressure or modulus, greater than zero): Shear stress above which the film is no longer
        Newtonian. Without it: "5 MPa". With friction_law = "film" lubricant = "oil".
    ``slip`` ("ellipse", "centre"): Slip over the contact ellipse, with spin and conformity, or at its centre,
        which costs less. Without it: "ellipse".
    ``slip_points_along`` (whole number, from 1 to 64): Points along rolling in a contact ellipse. Without it:
        4.
    ``slip_points_across`` (whole number, from 1 to 64): Points across rolling in a contact ellipse. Without
        it: 12.
    ``hunt_crossley`` (damping per speed of approach, zero or greater): Damping by Hunt and Crossley of each
        contact of ball and race. Without it: "1 s/m".
    ``rolling_loss`` (number, zero or greater): Hysteresis loss factor of rolling resistance. Without it:
        0.007.
    ``full_complement`` (true or false): Whether there is no cage and the balls touch each other. Without it:
        false.
    ``drag`` (table): Resistance of the lubricant around balls and cage, at rest with the outer ring.
    ``free_cage`` (table): The cage as a free body; without this table a pressed steel cage guided by the
        balls.
    """

    _table = "bearing"
    _fixed = {"model": "free_ball"}

    def __init__(
        self,
        name: str,
        *,
        station: str | None = None,
        housing: str | None = None,
        designation: str | None = None,
        balls: int | None = None,
        ball_diameter: str | None = None,
        pitch_diameter: str | None = None,
        inner_osculation: float | None = None,
        outer_osculation: float | None = None,
        inner_groove_radius: str | None = None,
        outer_groove_radius: str | None = None,
        radial_clearance: str | None = None,
        clearance: Literal["C2", "CN", "C3", "C4", "C5"] | None = None,
        bore: str | None = None,
        outside_diameter: str | None = None,
        width: str | None = None,
        material: str | None = None,
        ball_material: str | None = None,
        ring_material: str | None = None,
        cage: Literal["rolling"] | float | None = None,
        cage_angle: str | None = None,
        cage_pocket_diameter: str | None = None,
        contact_angle: str | None = None,
        thrust: Literal["+z", "-z"] | None = None,
        moment_arm: str | None = None,
        ball_inertia: Literal["auto", "none", "outer_race_control", "inner_race_control", "harris_inner_race_control", "shared", "centrifugal"] | Mapping[str, Any] | None = None,
        contact_stiffness: str | Mapping[str, Any] | None = None,
        lubricant: str | None = None,
        preload: Mapping[str, Any] | None = None,
        fit: Mapping[str, Any] | None = None,
        inner_waviness: Sequence[Mapping[str, Any]] | Mapping[str, Any] | None = None,
        outer_waviness: Sequence[Mapping[str, Any]] | Mapping[str, Any] | None = None,
        ball_waviness: Sequence[Mapping[str, Any]] | Mapping[str, Any] | None = None,
        off_size: Sequence[Mapping[str, Any]] | None = None,
        inner_eccentricity: Mapping[str, Any] | None = None,
        outer_eccentricity: Mapping[str, Any] | None = None,
        ball_spin: Literal["rolling", "shaft"] | None = None,
        defect: Sequence[Mapping[str, Any]] | None = None,
        defect_law: Literal["displacement", "undamped_displacement", "force", "force_on_loaded"] | None = None,
        defect_stiffness: str | None = None,
        lubrication: Literal["oil_bath", "oil_mist", "oil_jet", "grease"] | Mapping[str, Any] | None = None,
        sliding_friction: float | None = None,
        dynamic_rating: str | None = None,
        static_rating: str | None = None,
        fatigue_limit: str | None = None,
        contamination: float | None = None,
        reliability: float | None = None,
        inner_shoulder_diameter: str | None = None,
        outer_shoulder_diameter: str | None = None,
        friction_law: Literal["coulomb", "curve", "film"] | None = None,
        friction: float | None = None,
        slip_speed: str | None = None,
        traction_curve: Mapping[str, Any] | None = None,
        eyring_stress: str | None = None,
        slip: Literal["ellipse", "centre"] | None = None,
        slip_points_along: int | None = None,
        slip_points_across: int | None = None,
        hunt_crossley: str | None = None,
        rolling_loss: float | None = None,
        full_complement: bool | None = None,
        drag: Mapping[str, Any] | None = None,
        free_cage: Mapping[str, Any] | None = None,
    ) -> None:
        super().__init__(name, {
            "station": station,
            "housing": housing,
            "designation": designation,
            "balls": balls,
            "ball_diameter": ball_diameter,
            "pitch_diameter": pitch_diameter,
            "inner_osculation": inner_osculation,
            "outer_osculation": outer_osculation,
            "inner_groove_radius": inner_groove_radius,
            "outer_groove_radius": outer_groove_radius,
            "radial_clearance": radial_clearance,
            "clearance": clearance,
            "bore": bore,
            "outside_diameter": outside_diameter,
            "width": width,
            "material": material,
            "ball_material": ball_material,
            "ring_material": ring_material,
            "cage": cage,
            "cage_angle": cage_angle,
            "cage_pocket_diameter": cage_pocket_diameter,
            "contact_angle": contact_angle,
            "thrust": thrust,
            "moment_arm": moment_arm,
            "ball_inertia": ball_inertia,
            "contact_stiffness": contact_stiffness,
            "lubricant": lubricant,
            "preload": preload,
            "fit": fit,
            "inner_waviness": inner_waviness,
            "outer_waviness": outer_waviness,
            "ball_waviness": ball_waviness,
            "off_size": off_size,
            "inner_eccentricity": inner_eccentricity,
            "outer_eccentricity": outer_eccentricity,
            "ball_spin": ball_spin,
            "defect": defect,
            "defect_law": defect_law,
            "defect_stiffness": defect_stiffness,
            "lubrication": lubrication,
            "sliding_friction": sliding_friction,
            "dynamic_rating": dynamic_rating,
            "static_rating": static_rating,
            "fatigue_limit": fatigue_limit,
            "contamination": contamination,
            "reliability": reliability,
            "inner_shoulder_diameter": inner_shoulder_diameter,
            "outer_shoulder_diameter": outer_shoulder_diameter,
            "friction_law": friction_law,
            "friction": friction,
            "slip_speed": slip_speed,
            "traction_curve": traction_curve,
            "eyring_stress": eyring_stress,
            "slip": slip,
            "slip_points_along": slip_points_along,
            "slip_points_across": slip_points_across,
            "hunt_crossley": hunt_crossley,
            "rolling_loss": rolling_loss,
            "full_complement": full_complement,
            "drag": drag,
            "free_cage": free_cage,
        })


class LinearBearing(Part):
    """A bearing between the shaft and a housing, a body or ground. ``[bearing.NAME]`` of the model file with
    ``model = "linear"``.

    ``station`` (name of a station): Where it sits on the shaft; not in a file with bearings only. Required.
    ``housing`` (ground or name of a housing or body): What holds its outer ring. Without it: "ground".
    ``speed`` (speed of rotation: one or more, increasing, zero or greater): Speeds of a table; every
        component then has one value or one per speed. Without it: "0 rpm".
    ``whirl_frequency`` (speed of rotation: two or more, increasing, zero or greater): Frequencies of motion
        of a table, one value per frequency for each speed; only FRFs take others than the speed.
    ``beyond_table`` ("hold", "refuse", "extrapolate"): At speeds beyond a table of two or more: its last
        value, an error, or on along the last slope. Without it: "hold". With speed = "0, 3000 rpm".
    ``k_tilt`` (rotational stiffness: one, or one for each speed): Both tilts, about x and about y. Without
        it: 0.
    ``k_x`` (stiffness: one, or one for each speed): Translation along an axis, tilt about it, or spin about
        z. Without it: 0.
    ``k_y`` (stiffness: one, or one for each speed): Translation along an axis, tilt about it, or spin about
        z. Without it: 0.
    ``k_z`` (stiffness: one, or one for each speed): Translation along an axis, tilt about it, or spin about
        z. Without it: 0.
    ``k_tilt_x`` (rotational stiffness: one, or one for each speed): Translation along an axis, tilt about it,
        or spin about z. Without it: 0.
    ``k_tilt_y`` (rotational stiffness: one, or one for each speed): Translation along an axis, tilt about it,
        or spin about z. Without it: 0.
    ``k_spin`` (rotational stiffness: one, or one for each speed): Translation along an axis, tilt about it,
        or spin about z. Without it: 0.
    ``k_xx`` (stiffness: one, or one for each speed): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``k_xy`` (stiffness: one, or one for each speed): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``k_xz`` (stiffness: one, or one for each speed): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``k_xtx`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_xty`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_xtz`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_yx`` (stiffness: one, or one for each speed): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``k_yy`` (stiffness: one, or one for each speed): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``k_yz`` (stiffness: one, or one for each speed): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``k_ytx`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_yty`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_ytz`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_zx`` (stiffness: one, or one for each speed): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``k_zy`` (stiffness: one, or one for each speed): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``k_zz`` (stiffness: one, or one for each speed): Force or moment of the first DOF per motion of the
        second. Without it: 0.
    ``k_ztx`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_zty`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_ztz`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_txx`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_txy`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_txz`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_txtx`` (rotational stiffness: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``k_txty`` (rotational stiffness: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``k_txtz`` (rotational stiffness: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``k_tyx`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_tyy`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_tyz`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_tytx`` (rotational stiffness: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``k_tyty`` (rotational stiffness: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``k_tytz`` (rotational stiffness: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``k_tzx`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_tzy`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_tzz`` (stiffness between translation and tilt: one, or one for each speed): Force or moment of the
        first DOF per motion of the second. Without it: 0.
    ``k_tztx`` (rotational stiffness: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``k_tzty`` (rotational stiffness: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``k_tztz`` (rotational stiffness: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``c_tilt`` (rotational damping: one, or one for each speed): Both tilts, about x and about y. Without it:
        0.
    ``c_x`` (damping: one, or one for each speed): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``c_y`` (damping: one, or one for each speed): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``c_z`` (damping: one, or one for each speed): Translation along an axis, tilt about it, or spin about z.
        Without it: 0.
    ``c_tilt_x`` (rotational damping: one, or one for each speed): Translation along an axis, tilt about it,
        or spin about z. Without it: 0.
    ``c_tilt_y`` (rotational damping: one, or one for each speed): Translation along an axis, tilt about it,
        or spin about z. Without it: 0.
    ``c_spin`` (rotational damping: one, or one for each speed): Translation along an axis, tilt about it, or
        spin about z. Without it: 0.
    ``c_xx`` (damping: one, or one for each speed): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_xy`` (damping: one, or one for each speed): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_xz`` (damping: one, or one for each speed): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_xtx`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_xty`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_xtz`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_yx`` (damping: one, or one for each speed): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_yy`` (damping: one, or one for each speed): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_yz`` (damping: one, or one for each speed): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_ytx`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_yty`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_ytz`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_zx`` (damping: one, or one for each speed): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_zy`` (damping: one, or one for each speed): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_zz`` (damping: one, or one for each speed): Force or moment of the first DOF per motion of the second.
        Without it: 0.
    ``c_ztx`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_zty`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_ztz`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_txx`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_txy`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_txz`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_txtx`` (rotational damping: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``c_txty`` (rotational damping: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``c_txtz`` (rotational damping: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``c_tyx`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_tyy`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_tyz`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_tytx`` (rotational damping: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``c_tyty`` (rotational damping: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``c_tytz`` (rotational damping: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``c_tzx`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_tzy`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_tzz`` (damping between translation and tilt: one, or one for each speed): Force or moment of the first
        DOF per motion of the second. Without it: 0.
    ``c_tztx`` (rotational damping: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``c_tzty`` (rotational damping: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``c_tztz`` (rotational damping: one, or one for each speed): Force or moment of the first DOF per motion
        of the second. Without it: 0.
    ``stiffness_si`` (number: 6 x 6 in SI units): Whole matrix, rows and columns u_x u_y u_z theta_x theta_y
        theta_z. Without it: from its components.
    ``damping_si`` (number: 6 x 6 in SI units): Whole matrix, rows and columns u_x u_y u_z theta_x theta_y
        theta_z. Without it: from its components.
    """

    _table = "bearing"
    _fixed = {"model": "linear"}

    def __init__(
        self,
        name: str,
        *,
        station: str | None = None,
        housing: str | None = None,
        speed: str | Sequence[str] | None = None,
        whirl_frequency: str | Sequence[str] | None = None,
        beyond_table: Literal["hold", "refuse", "extrapolate"] | None = None,
        k_tilt: str | Sequence[str] | None = None,
        k_x: str | Sequence[str] | None = None,
        k_y: str | Sequence[str] | None = None,
        k_z: str | Sequence[str] | None = None,
        k_tilt_x: str | Sequence[str] | None = None,
        k_tilt_y: str | Sequence[str] | None = None,
        k_spin: str | Sequence[str] | None = None,
        k_xx: str | Sequence[str] | None = None,
        k_xy: str | Sequence[str] | None = None,
        k_xz: str | Sequence[str] | None = None,
        k_xtx: str | Sequence[str] | None = None,
        k_xty: str | Sequence[str] | None = None,
        k_xtz: str | Sequence[str] | None = None,
        k_yx: str | Sequence[str] | None = None,
        k_yy: str | Sequence[str] | None = None,
        k_yz: str | Sequence[str] | None = None,
        k_ytx: str | Sequence[str] | None = None,
        k_yty: str | Sequence[str] | None = None,
        k_ytz: str | Sequence[str] | None = None,
        k_zx: str | Sequence[str] | None = None,
        k_zy: str | Sequence[str] | None = None,
        k_zz: str | Sequence[str] | None = None,
        k_ztx: str | Sequence[str] | None = None,
        k_zty: str | Sequence[str] | None = None,
        k_ztz: str | Sequence[str] | None = None,
        k_txx: str | Sequence[str] | None = None,
        k_txy: str | Sequence[str] | None = None,
        k_txz: str | Sequence[str] | None = None,
        k_txtx: str | Sequence[str] | None = None,
        k_txty: str | Sequence[str] | None = None,
        k_txtz: str | Sequence[str] | None = None,
        k_tyx: str | Sequence[str] | None = None,
        k_tyy: str | Sequence[str] | None = None,
        k_tyz: str | Sequence[str] | None = None,
        k_tytx: str | Sequence[str] | None = None,
        k_tyty: str | Sequence[str] | None = None,
        k_tytz: str | Sequence[str] | None = None,
        k_tzx: str | Sequence[str] | None = None,
        k_tzy: str | Sequence[str] | None = None,
        k_tzz: str | Sequence[str] | None = None,
        k_tztx: str | Sequence[str] | None = None,
        k_tzty: str | Sequence[str] | None = None,
        k_tztz: str | Sequence[str] | None = None,
        c_tilt: str | Sequence[str] | None = None,
        c_x: str | Sequence[str] | None = None,
        c_y: str | Sequence[str] | None = None,
        c_z: str | Sequence[str] | None = None,
        c_tilt_x: str | Sequence[str] | None = None,
        c_tilt_y: str | Sequence[str] | None = None,
        c_spin: str | Sequence[str] | None = None,
        c_xx: str | Sequence[str] | None = None,
        c_xy: str | Sequence[str] | None = None,
        c_xz: str | Sequence[str] | None = None,
        c_xtx: str | Sequence[str] | None = None,
        c_xty: str | Sequence[str] | None = None,
        c_xtz: str | Sequence[str] | None = None,
        c_yx: str | Sequence[str] | None = None,
        c_yy: str | Sequence[str] | None = None,
        c_yz: str | Sequence[str] | None = None,
        c_ytx: str | Sequence[str] | None = None,
        c_yty: str | Sequence[str] | None = None,
        c_ytz: str | Sequence[str] | None = None,
        c_zx: str | Sequence[str] | None = None,
        c_zy: str | Sequence[str] | None = None,
        c_zz: str | Sequence[str] | None = None,
        c_ztx: str | Sequence[str] | None = None,
        c_zty: str | Sequence[str] | None = None,
        c_ztz: str | Sequence[str] | None = None,
        c_txx: str | Sequence[str] | None = None,
        c_txy: str | Sequence[str] | None = None,
        c_txz: str | Sequence[str] | None = None,
        c_txtx: str | Sequence[str] | None = None,
        c_txty: str | Sequence[str] | None = None,
        c_txtz: str | Sequence[str] | None = None,
        c_tyx: str | Sequence[str] | None = None,
        c_tyy: str | Sequence[str] | None = None,
        c_tyz: str | Sequence[str] | None = None,
        c_tytx: str | Sequence[str] | None = None,
        c_tyty: str | Sequence[str] | None = None,
        c_tytz: str | Sequence[str] | None = None,
        c_tzx: str | Sequence[str] | None = None,
        c_tzy: str | Sequence[str] | None = None,
        c_tzz: str | Sequence[str] | None = None,
        c_tztx: str | Sequence[str] | None = None,
        c_tzty: str | Sequence[str] | None = None,
        c_tztz: str | Sequence[str] | None = None,
        stiffness_si: float | Sequence[float] | str | None = None,
        damping_si: float | Sequence[float] | str | None = None,
    ) -> None:
        super().__init__(name, {
            "station": station,
            "housing": housing,
            "speed": speed,
            "whirl_frequency": whirl_frequency,
            "beyond_table": beyond_table,
            "k_tilt": k_tilt,
            "k_x": k_x,
            "k_y": k_y,
            "k_z": k_z,
            "k_tilt_x": k_tilt_x,
            "k_tilt_y": k_tilt_y,
            "k_spin": k_spin,
            "k_xx": k_xx,
            "k_xy": k_xy,
            "k_xz": k_xz,
            "k_xtx": k_xtx,
            "k_xty": k_xty,
            "k_xtz": k_xtz,
            "k_yx": k_yx,
            "k_yy": k_yy,
            "k_yz": k_yz,
            "k_ytx": k_ytx,
            "k_yty": k_yty,
            "k_ytz": k_ytz,
            "k_zx": k_zx,
            "k_zy": k_zy,
            "k_zz": k_zz,
            "k_ztx": k_ztx,
            "k_zty": k_zty,
            "k_ztz": k_ztz,
            "k_txx": k_txx,
            "k_txy": k_txy,
            "k_txz": k_txz,
            "k_txtx": k_txtx,
            "k_txty": k_txty,
            "k_txtz": k_txtz,
            "k_tyx": k_tyx,
            "k_tyy": k_tyy,
            "k_tyz": k_tyz,
            "k_tytx": k_tytx,
            "k_tyty": k_tyty,
            "k_tytz": k_tytz,
            "k_tzx": k_tzx,
            "k_tzy": k_tzy,
            "k_tzz": k_tzz,
            "k_tztx": k_tztx,
            "k_tzty": k_tzty,
            "k_tztz": k_tztz,
            "c_tilt": c_tilt,
            "c_x": c_x,
            "c_y": c_y,
            "c_z": c_z,
            "c_tilt_x": c_tilt_x,
            "c_tilt_y": c_tilt_y,
            "c_spin": c_spin,
            "c_xx": c_xx,
            "c_xy": c_xy,
            "c_xz": c_xz,
            "c_xtx": c_xtx,
            "c_xty": c_xty,
            "c_xtz": c_xtz,
            "c_yx": c_yx,
            "c_yy": c_yy,
            "c_yz": c_yz,
            "c_ytx": c_ytx,
            "c_yty": c_yty,
            "c_ytz": c_ytz,
            "c_zx": c_zx,
            "c_zy": c_zy,
            "c_zz": c_zz,
            "c_ztx": c_ztx,
            "c_zty": c_zty,
            "c_ztz": c_ztz,
            "c_txx": c_txx,
            "c_txy": c_txy,
            "c_txz": c_txz,
            "c_txtx": c_txtx,
            "c_txty": c_txty,
            "c_txtz": c_txtz,
            "c_tyx": c_tyx,
            "c_tyy": c_tyy,
            "c_tyz": c_tyz,
            "c_tytx": c_tytx,
            "c_tyty": c_tyty,
            "c_tytz": c_tytz,
            "c_tzx": c_tzx,
            "c_tzy": c_tzy,
            "c_tzz": c_tzz,
            "c_tztx": c_tztx,
            "c_tzty": c_tzty,
            "c_tztz": c_tztz,
            "stiffness_si": stiffness_si,
            "damping_si": damping_si,
        })


class ShaftUnbalance(Part):
    """Unbalance at a station: a magnitude, a mass at a radius, or a balance grade. ``[unbalance.NAME]`` of the
    model file.

    ``station`` (name of a station): Where it sits. Required.
    ``magnitude`` (unbalance, zero or greater): Unbalance. Without it: required, or mass, or grade.
    ``mass`` (mass, zero or greater): Mass at a radius. Without it: required, or magnitude, or grade.
    ``radius`` (length, greater than zero): Radius at which the mass is. Without it: required, with mass. With
        mass = "5 g".
    ``grade`` (a balance quality grade): Permissible unbalance of ISO 21940-11 at a speed. Without it:
        required, or magnitude, or mass.
    ``speed`` (speed of rotation, greater than zero): Service speed, of any grade. Without it: required, with
        grade. With grade = "G6.3".
    ``rotor_mass`` (mass, greater than zero): Mass of the rotor, of any grade. Without it: shaft and discs.
        With grade = "G6.3".
    ``phase`` (angle): Position from +x towards +y at a shaft angle of zero. Without it: "0 deg".
    """

    _table = "unbalance"

    def __init__(
        self,
        name: str,
        *,
        station: str | None = None,
        magnitude: str | None = None,
        mass: str | None = None,
        radius: str | None = None,
        grade: str | None = None,
        speed: str | None = None,
        rotor_mass: str | None = None,
        phase: str | None = None,
    ) -> None:
        super().__init__(name, {
            "station": station,
            "magnitude": magnitude,
            "mass": mass,
            "radius": radius,
            "grade": grade,
            "speed": speed,
            "rotor_mass": rotor_mass,
            "phase": phase,
        })


class Load(Part):
    """A force or moment in the axes of the model: constant, over time or random; constant loads act in statics.
    ``[load.NAME]`` of the model file.

    ``at`` (name of a station, disc, body, housing or ground): Where it acts. Required.
    ``offset`` (length: three: x, y, z): Distance from there; on ground the position. Without it: "0, 0, 0 m".
    ``force`` (force: three: x, y, z): Force, constant, times factor or random. Without it: required, or
        moment.
    ``moment`` (moment: three: about x, y, z): Moment, constant, times factor or random. Without it: required,
        or force.
    ``time`` (time: one or more, increasing): Times of a load history, with straight lines between them; it is
        no part of the statics, a run starts without it. Without it: required, with factor. With factor = [0,
        1].
    ``factor`` (number: as many as time): Factor of the load at these times; the first holds from the start of
        the run, the last to its end: 0 where there is no load. Without it: required, with time. With time =
        "0, 0.1 s".
    ``band`` (frequency: two, increasing, zero or greater): A random load: flat spectrum from 5 % of the width
        inside these frequencies, -6 dB at them; force and moment: RMS.
    ``seed`` (whole number, from 0 to 999999999): Random course of a load with a band: the same for equal
        seeds. Without it: one of its own, from the load's name. With band = "5, 500 Hz".
    """

    _table = "load"

    def __init__(
        self,
        name: str,
        *,
        at: str | None = None,
        offset: str | Sequence[str] | None = None,
        force: str | Sequence[str] | None = None,
        moment: str | Sequence[str] | None = None,
        time: str | Sequence[str] | None = None,
        factor: float | Sequence[float] | str | None = None,
        band: str | Sequence[str] | None = None,
        seed: int | None = None,
    ) -> None:
        super().__init__(name, {
            "at": at,
            "offset": offset,
            "force": force,
            "moment": moment,
            "time": time,
            "factor": factor,
            "band": band,
            "seed": seed,
        })


class Probe(Part):
    """A channel: motion of a point along a direction. ``[probe.NAME]`` of the model file.

    ``at`` (name of a station, disc, body, housing or ground): Where it acts. Required.
    ``offset`` (length: three: x, y, z): Distance from there; on ground the position. Without it: "0, 0, 0 m".
    ``direction`` (x, y, z, or tx, ty, tz for a rotation, - for the opposite or number: three, or six with
        rotations): Direction by name. Direction by components, scaled to unit translation, else to unit
        rotation; rotations in rad per metre of it. Required.
    ``quantity`` ("displacement", "velocity", "acceleration"): What is measured. Without it: "displacement".
    """

    _table = "probe"

    def __init__(
        self,
        name: str,
        *,
        at: str | None = None,
        offset: str | Sequence[str] | None = None,
        direction: str | float | Sequence[float] | str | None = None,
        quantity: Literal["displacement", "velocity", "acceleration"] | None = None,
    ) -> None:
        super().__init__(name, {
            "at": at,
            "offset": offset,
            "direction": direction,
            "quantity": quantity,
        })


class Damping(Part):
    """Damping of the whole structure. ``[damping]`` of the model file.

    ``mass`` (rate, zero or greater): Rayleigh damping, factor of the mass matrix. Without it: "0 1/s".
    ``stiffness`` (time, zero or greater): Rayleigh damping, factor of the stiffness matrix. Without it: "0
        s".
    ``modal`` (table): Damping ratios over frequency, linear between the points.
    """

    _table = "damping"

    def __init__(
        self,
        *,
        mass: str | None = None,
        stiffness: str | None = None,
        modal: Mapping[str, Any] | None = None,
    ) -> None:
        super().__init__(None, {
            "mass": mass,
            "stiffness": stiffness,
            "modal": modal,
        })


class Drive(Part):
    """How the shaft is driven. ``[drive]`` of the model file.

    ``kind`` ("prescribed", "torque"): Speed as prescribed by [speed], or rotation as an unknown with a torque
        on the shaft. Required.
    ``station`` (name of a station): Where the drive acts. Without it: required, with kind = "torque".
    ``speed`` (speed of rotation: one or more, increasing): Speeds of the torque-speed characteristic. Without
        it: required, with kind = "torque". With kind = "torque".
    ``torque`` (moment: as many as speed): Torques of the characteristic. Without it: required, with kind =
        "torque". With kind = "torque".
    ``drag`` (rotational damping, zero or greater): Viscous drag torque over speed of a torque drive. Without
        it: "0 N m s/rad". With kind = "torque".
    """

    _table = "drive"

    def __init__(
        self,
        *,
        kind: Literal["prescribed", "torque"] | None = None,
        station: str | None = None,
        speed: str | Sequence[str] | None = None,
        torque: str | Sequence[str] | None = None,
        drag: str | None = None,
    ) -> None:
        super().__init__(None, {
            "kind": kind,
            "station": station,
            "speed": speed,
            "torque": torque,
            "drag": drag,
        })


class SpeedProfile(Part):
    """Speed over time, of run-ups. ``[speed]`` of the model file.

    ``profile`` ("constant", "ramp", "s-curve", "table", "coast-down", "measured"): Form of the speed over
        time; s-curve is a ramp without jumps of the acceleration. Required.
    ``speed`` (speed of rotation, zero or greater or speed of rotation: as many as time, zero or greater):
        Speed. Speeds at these times; between them a smooth curve (monotone cubic, PCHIP) without overshoot,
        not straight lines. Required. With profile = "constant".
    ``duration`` (time, greater than zero): Duration. Required. With profile = "constant".
    ``from_`` (speed of rotation, zero or greater or time, zero or greater): Speed at the start. Start of the
        part used. Without it: "0 rpm". With profile = "ramp" or profile = "s-curve".
    ``to`` (speed of rotation, zero or greater or time, greater than zero): Speed at the end. End of the part
        used. With profile = "ramp" or profile = "s-curve".
    ``settle`` (time, zero or greater): Time at the speed of the start, before the ramp. Time at this speed
        before the coast-down. Without it: "0 s". With profile = "ramp" or profile = "s-curve".
    ``ramp`` (time, greater than zero): Duration of the ramp. Required. With profile = "ramp" or profile =
        "s-curve".
    ``hold`` (time, zero or greater): Time at the speed of the end, after the ramp. Without it: "0 s". With
        profile = "ramp" or profile = "s-curve".
    ``time`` (time: two or more, increasing, zero or greater): Times. Required. With profile = "table".
    ``time_constant`` (time, greater than zero): Time in which the speed falls to 1/e. Required. With profile
        = "coast-down".
    ``pulses`` (time: four or more, increasing, zero or greater): Times of the tacho pulses. Without it:
        required, or file. With profile = "measured".
    ``file`` (path from the folder of the model file): Data file with pulse times, or with speeds and time.
        Without it: required, or pulses. With profile = "measured".
    ``column`` (name of a column): Column of the file. Without it: the only one beside time. With profile =
        "measured", file = "tacho.csv".
    ``unit`` (s, ms, us, rpm, rad/s or Hz): Unit of the column. Without it: as the file says. With profile =
        "measured", file = "tacho.csv".
    ``pulses_per_revolution`` (whole number, from 1 to 10000): Pulses per revolution. Without it: 1. With
        profile = "measured".
    ``smoothing`` (whole number, from 0 to 100): Pulses averaged on either side; 1 is no smoothing and
        refused. Without it: 0. With profile = "measured".
    """

    _table = "speed"

    def __init__(
        self,
        *,
        profile: Literal["constant", "ramp", "s-curve", "table", "coast-down", "measured"] | None = None,
        speed: str | str | Sequence[str] | None = None,
        duration: str | None = None,
        from_: str | None = None,
        to: str | None = None,
        settle: str | None = None,
        ramp: str | None = None,
        hold: str | None = None,
        time: str | Sequence[str] | None = None,
        time_constant: str | None = None,
        pulses: str | Sequence[str] | None = None,
        file: str | None = None,
        column: str | None = None,
        unit: str | None = None,
        pulses_per_revolution: int | None = None,
        smoothing: int | None = None,
    ) -> None:
        super().__init__(None, {
            "profile": profile,
            "speed": speed,
            "duration": duration,
            "from": from_,
            "to": to,
            "settle": settle,
            "ramp": ramp,
            "hold": hold,
            "time": time,
            "time_constant": time_constant,
            "pulses": pulses,
            "file": file,
            "column": column,
            "unit": unit,
            "pulses_per_revolution": pulses_per_revolution,
            "smoothing": smoothing,
        })
