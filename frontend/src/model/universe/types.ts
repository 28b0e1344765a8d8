/**
 * The types of universe documents: worlds as YAML. SI units; poses are [x, y, z, roll, pitch, yaw] in the
 * world frame.
 */

import type { JsonObject, Point, Pose, Vector } from '../document/values';

export type Shape = 'box' | 'cylinder' | 'sphere' | 'plane' | 'mesh' | 'urdf' | 'sdf';

/** The labels of the numbers of `size`, by shape: keys of texts. */
export const SIZE_MEANING: Readonly<Record<Shape, readonly string[]>> = {
  box: ['x', 'y', 'z'],
  cylinder: ['radius', 'length'],
  sphere: ['radius'],
  plane: ['x', 'y'],
  mesh: ['scaleX', 'scaleY', 'scaleZ'],
  urdf: [],
  sdf: [],
};

/** The file extensions of the shapes that have a file. */
export const FILES: Readonly<Partial<Record<Shape, RegExp>>> = {
  mesh: /\.(stl|obj|dae|ply|glb)$/i,
  urdf: /\.(urdf|xacro)$/i,
  sdf: /\.sdf$/i,
};

export const TEXTURES = ['asphalt', 'brick', 'carpet', 'checker', 'grass', 'tiles', 'wood'] as const;
export const PICTURE = /\.(png|jpe?g)$/i;

export type Section = 'models' | 'actors' | 'robots' | 'areas';
/** The sections that are lists; areas are a mapping by name. */
export const SECTIONS: readonly Exclude<Section, 'areas'>[] = ['models', 'actors', 'robots'];

interface Placed {
  /** The id of the thing, or the id with a mark if two things share it. */
  readonly key: string;
  readonly id: string;
  readonly section: Section;
  readonly index: number;
}

export interface ModelThing extends Placed {
  readonly section: 'models';
  readonly shape: Shape;
  readonly size: readonly number[];
  readonly file: string;
  readonly pose: Pose;
  readonly color: string;
  /** The name of a built-in texture, the path of a picture in the project, or empty. */
  readonly texture: string;
  /** The size of one repetition of the texture in m; null if the document does not set it. */
  readonly tile: Point | null;
  readonly mass: number;
  readonly friction: number;
  readonly restitution: number;
  readonly solid: boolean;
  /** Whether robots' cameras see the wall as high as the ceiling. */
  readonly to_ceiling: boolean;
}

export interface ActorThing extends Placed {
  readonly section: 'actors';
  readonly color: string;
  readonly path: readonly Point[];
  readonly speed: number;
  readonly loop: boolean;
  readonly start_m: number;
  /** Whether the person waits for a robot in the way. */
  readonly yields: boolean;
}

export interface RobotThing extends Placed {
  readonly section: 'robots';
  readonly model: string;
  readonly pose: Pose;
  /** The topics that are renamed for this robot, by sensor or joint. */
  readonly topics: Readonly<Record<string, string>>;
}

/** A named area of the floor; `path` are its corners in order. */
export interface AreaThing extends Placed {
  readonly section: 'areas';
  readonly shape: 'box' | 'polygon';
  readonly path: readonly Point[];
}

export type Thing = ModelThing | ActorThing | RobotThing | AreaThing;

/** A thing that is points of the floor, and has no pose: a person with a path, or an area. */
export const hasPath = (thing: Thing): thing is ActorThing | AreaThing => 'path' in thing;

export interface Light {
  readonly direction: Vector;
  readonly intensity: number;
}

/** The part of a document that can be shown, with defaults for missing or invalid values. */
export interface Universe {
  /** The parsed document. */
  readonly raw: JsonObject;
  readonly name: string;
  readonly description: string;
  readonly ground: {
    readonly color: string;
    readonly texture: string;
    readonly tile: Point | null;
    readonly friction: number;
  };
  /** The ceiling of an indoor world; null without one. */
  readonly ceiling: {
    readonly color: string;
    readonly texture: string;
    readonly tile: Point | null;
    readonly height: number;
  } | null;
  readonly things: readonly Thing[];
  readonly lights: readonly Light[];
  readonly view: { readonly eye: Vector; readonly target: Vector };
  readonly random: Readonly<Record<string, readonly [number, number]>>;
}

export const thingOf = (universe: Universe, key: string): Thing | undefined =>
  universe.things.find((thing) => thing.key === key);
