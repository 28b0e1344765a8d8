/**
 * The types of a robot: drive and sensors (`robot.yaml`), and the body (a URDF). SI units, frame of the root
 * link.
 */

import type { JsonObject, Pose } from '../document/values';
import type { Urdf } from './urdf';

export type SensorKind = 'lidar' | 'camera' | 'imu' | 'bumper' | 'battery';
export const SENSOR_KINDS: readonly SensorKind[] = ['lidar', 'camera', 'imu', 'bumper', 'battery'];

/** The message types that a robot accepts on `/cmd_vel`. */
export const COMMAND_TYPES = ['both', 'twist', 'twist_stamped'] as const;
export type CommandType = (typeof COMMAND_TYPES)[number];

export interface Sensor {
  readonly index: number;
  readonly kind: SensorKind;
  readonly name: string;
  /** null for a battery, which has no link. */
  readonly link: string | null;
  readonly raw: JsonObject;
}

export type PartKind = 'base' | 'wheel' | 'caster' | 'link' | SensorKind;

/** A part of a robot that can be selected. */
export interface Part {
  readonly key: string;
  readonly kind: PartKind;
  readonly name: string;
  readonly link: string | null;
  /** The link whose shapes this part draws; null if another part draws them. */
  readonly shows: string | null;
  readonly sensor: Sensor | null;
  readonly pose: Pose;
}

export interface Robot {
  /** The parsed `robot.yaml`. */
  readonly raw: JsonObject;
  readonly name: string;
  readonly description: string;
  readonly drive: JsonObject;
  readonly commandType: CommandType;
  /** Whether the robot publishes its true pose. */
  readonly groundTruth: boolean;
  /** The names of the driven wheels' joints. */
  readonly left: readonly string[];
  readonly right: readonly string[];
  readonly wheelRadius: number;
  readonly track: number;
  readonly sensors: readonly Sensor[];
  readonly parts: readonly Part[];
  readonly urdf: Urdf;
  readonly urdfText: string;
}

export const partOf = (robot: Robot, key: string): Part | undefined =>
  robot.parts.find((part) => part.key === key);
