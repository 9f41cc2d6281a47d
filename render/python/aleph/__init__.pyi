# Types of the module. Shapes, units and meanings are in the docstrings: help(aleph.render).
import os
from collections.abc import Callable, Iterator, Mapping, Sequence as _Sequence
from fractions import Fraction
from typing import Any, Final, Generic, TypeVar, Union, overload

import numpy as np
import numpy.typing as npt

_E = TypeVar("_E")
_Path = Union[str, os.PathLike[str]]
_Floats = npt.NDArray[np.float32]
_Doubles = npt.NDArray[np.float64]
_Bytes = npt.NDArray[np.int8]
_Number = Union[float, "Track"]
_Vector = Union[npt.ArrayLike, "Track"]
_Setting = Union[bool, float, str, _Sequence[Any], Callable[..., Any], None]
_Progress = Union[Callable[[float, str], object], None]
_Picture = Union[npt.NDArray[Any], "Frame"]

__version__: str

class InputError(ValueError):
    file: str
    place: str
    reason: str

class OutputError(OSError): ...

class Track:
    def __init__(self, times: npt.ArrayLike, values: npt.ArrayLike, interpolation: str = "linear") -> None: ...
    times: Final[_Doubles]
    values: Final[_Doubles]
    interpolation: Final[str]
    def __len__(self) -> int: ...

class _Element:
    name: Final[str]
    index: Final[int]

class _Elements(Generic[_E]):
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, index: int) -> _E: ...
    @overload
    def __getitem__(self, name: str) -> _E: ...
    def __contains__(self, name: str) -> bool: ...
    def __iter__(self) -> Iterator[_E]: ...

class Material(_Element):
    base_color: _Vector
    alpha: _Number
    emission: _Vector
    emission_strength: _Number
    metallic: _Number
    roughness: _Number
    specular: _Number
    specular_color: _Vector
    ior: _Number
    transmission: _Number
    thickness: _Number
    attenuation_distance: _Number
    attenuation_color: _Vector
    clearcoat: _Number
    clearcoat_roughness: _Number
    sheen_color: _Vector
    sheen_roughness: _Number
    anisotropy: _Number
    anisotropy_rotation: _Number
    unlit: bool
    double_sided: bool

class Light(_Element):
    kind: Final[str]
    color: _Vector
    intensity: _Number
    range: _Number
    inner_cone: _Number
    outer_cone: _Number

class Camera(_Element):
    orthographic: bool
    fov: _Number
    half_height: _Number
    shift_x: _Number
    shift_y: _Number
    aperture: _Number
    focus_distance: _Number
    shutter: tuple[float, float]

class Mesh(_Element):
    positions: npt.NDArray[np.float32]
    triangles: Final[npt.NDArray[np.uint32]]
    material: Material | None
    present: _Number

class Node(_Element):
    parent: Final[Node | None]
    meshes: Final[list[Mesh]]
    camera: Final[Camera | None]
    light: Final[Light | None]
    translation: _Vector
    rotation: Any
    scale: _Vector
    matrix: _Vector | None
    visible: _Number

class Scene:
    nodes: Final[_Elements[Node]]
    materials: Final[_Elements[Material]]
    meshes: Final[_Elements[Mesh]]
    lights: Final[_Elements[Light]]
    cameras: Final[_Elements[Camera]]
    name: Final[str]
    warnings: Final[list[str]]
    settings: Final[dict[str, bool | float | str]]
    fps: float | str | Fraction
    frames: tuple[int, int]
    camera: str
    exposure: float | None
    def seconds(self, frames: npt.ArrayLike) -> Any: ...
    def world(self, node: str, frame: float) -> _Doubles: ...
    def worlds(self, frame: float) -> _Doubles: ...
    def save(self, path: _Path) -> list[str]: ...
    def to_dict(self) -> dict[str, Any]: ...
    def copy(self) -> Scene: ...

class Frame:
    color: Final[_Floats | None]
    estimate: Final[_Floats | None]
    samples: Final[_Floats | None]
    error: Final[_Floats | None]
    variance: Final[_Floats | None]
    depth: Final[_Floats | None]
    normal: Final[_Floats | None]
    albedo: Final[_Floats | None]
    motion: Final[_Doubles | None]
    motion_valid: Final[_Bytes | None]
    backward: Final[_Doubles | None]
    backward_valid: Final[_Bytes | None]
    velocity: Final[_Floats | None]
    aleph: Final[_Floats | None]
    threshold: Final[_Floats | None]
    threshold_noise: Final[_Floats | None]
    accuracy: Final[_Floats | None]
    saliency: Final[_Floats | None]
    retinal_velocity: Final[_Floats | None]
    number: Final[int]
    exposure: Final[float]
    statistics: Final[dict[str, Any]]
    plan: Final[list[dict[str, Any]]]
    def save(self, path: _Path) -> None: ...

class Sequence:
    def __init__(self, scene: Scene | _Path | Mapping[str, Any], *, camera: str = "", threads: int = 0,
                 **settings: _Setting) -> None: ...
    def render(self, frame: int, *, maps: bool = True, picture: bool = True, on_progress: _Progress = None) -> Frame: ...
    def edit(self, change: Callable[[Scene], object]) -> None: ...
    frames: Final[tuple[int, int]]
    exposure: Final[float]

class Table(dict[str, list[Any]]):
    results: dict[str, Any] | None
    def rows(self) -> list[dict[str, Any]]: ...

def load(source: _Path | Mapping[str, Any], folder: _Path = ".") -> Scene: ...
def render(scene: Scene | _Path | Mapping[str, Any], frame: int | None = None, *, maps: bool = True, camera: str = "",
           threads: int = 0, on_progress: _Progress = None, **settings: _Setting) -> Frame: ...
def maps(images: _Sequence[npt.NDArray[Any]], *, fps: float | str | Fraction,
         motion: _Sequence[npt.NDArray[Any]] | None = None, cuts: _Sequence[int] = (), threads: int = 0,
         on_progress: _Progress = None, **settings: _Setting) -> list[Frame]: ...
def compare(a: _Picture, b: _Picture, threshold: npt.NDArray[Any] | Frame | None = None, *,
            display_white: float = 100.0, tolerance: float = 0.0) -> dict[str, Any]: ...
def seen(a: _Sequence[_Picture], b: _Sequence[_Picture], maps: _Sequence[Frame], *,
         cuts: _Sequence[int] = ()) -> dict[str, float | None]: ...
def study(scene: _Path | Mapping[str, Any], frames: str | int | _Sequence[int] = "",
          sweep: Mapping[str, _Sequence[Any]] | None = None, *,
          variants: Mapping[str, Mapping[str, Any]] | None = None, pictures: Mapping[str, str] | None = None, size: str | tuple[int, int] = (320, 240),
          settings: Mapping[str, Any] | None = None, reference: Mapping[str, Any] | None = None,
          metrics: _Sequence[str] | None = None, viewers: _Sequence[Mapping[str, Any]] | None = None, seeds: int = 1,
          folder: _Path | None = None, threads: int = 0, on_progress: _Progress = None) -> Table: ...
def add_vision(name: str, elevation: Callable[..., npt.ArrayLike],
               threshold: Callable[[npt.NDArray[Any]], npt.ArrayLike] | None = None) -> None: ...
