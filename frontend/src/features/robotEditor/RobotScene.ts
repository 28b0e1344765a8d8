import * as THREE from 'three';
import { setThingPose } from '@/features/editor3d/scene/Gizmo';
import { box, frameOf, markLines } from '@/features/editor3d/scene/marks';
import { ThingScene } from '@/features/editor3d/scene/ThingScene';
import { pyramidOf } from '@/features/viewer/scene/HelperViews';
import type { Shape } from '@/generated/messages';
import type { Pose } from '@/model/document/values';
import { below, type Solid } from '@/model/robot/urdf';
import type { Part, Robot } from '@/model/robot/types';

/** The size in m of the cube that is drawn for an invisible part. */
const HANDLE_M = 0.024;
const HANDLE_COLOR = [0.44, 0.49, 1, 1];
/** The longest drawn range of a sensor in m; its real range would hide the robot. */
const FARTHEST_M = 0.8;
const FRAME_PAD_M = 0.006;

function placeOf([x, y, z, roll, pitch, yaw]: Pose): number[] {
  const turn = new THREE.Quaternion().setFromEuler(new THREE.Euler(roll, pitch, yaw, 'ZYX'));
  return [x, y, z, ...turn.toArray()];
}

const number = (value: unknown, fallback: number): number => (typeof value === 'number' ? value : fallback);

/** The three.js objects of a robot's parts. */
export class RobotScene extends ThingScene<Part> {
  private robot: Robot | null = null;

  /** Creates the scene. `folder` is the folder of the URDF, to which the mesh names are relative. */
  constructor(
    isSimple: boolean,
    onArrival: () => void,
    private readonly folder: string,
    opacity = 1,
  ) {
    super(isSimple, onArrival, null, opacity);
  }

  /** Draws a robot, or only some of its parts. */
  showRobot(robot: Robot | null, parts: readonly Part[] = robot?.parts ?? []): void {
    this.robot = robot;
    this.show(parts);
  }

  /** Returns the objects that a gesture moves: the given parts and all parts attached to them. */
  heldNodesOf(keys: readonly string[]): THREE.Object3D[] {
    const { robot } = this;
    if (!robot) return [];
    const links = new Set(
      robot.parts
        .filter(({ key, link }) => keys.includes(key) && link !== null)
        .flatMap(({ link }) => below(robot.urdf, link ?? '')),
    );
    return robot.parts
      .filter(({ link }) => link !== null && links.has(link))
      .flatMap(({ key }) => this.nodeOf(key) ?? []);
  }

  protected override lookOf(part: Part): unknown {
    return [part.kind, this.shapesOf(part), part.sensor?.raw];
  }

  protected stateOf(part: Part): unknown {
    return this.arrivals({ value: this.shapesOf(part), failed: false });
  }

  protected fill(node: THREE.Group, part: Part): void {
    if (part.kind === 'battery') return;
    this.addShapes(node, { value: this.shapesOf(part), failed: false }, HANDLE_M);
    if (node.children.length === 0) {
      const handle = box(HANDLE_M, HANDLE_COLOR);
      handle.position.z = 0;
      node.add(handle);
    }
    node.add(frameOf(node, FRAME_PAD_M));
    const sight = sightOf(part);
    if (sight) node.add(markLines(sight));
  }

  protected put(node: THREE.Group, part: Part): void {
    setThingPose(node, part.pose);
  }

  private shapesOf({ shows }: Part): Shape[] {
    const visuals = shows === null ? [] : (this.robot?.urdf.links.get(shows)?.visuals ?? []);
    return visuals.map((solid) => this.shapeOf(solid));
  }

  private shapeOf({ shape, size, pose, color, file }: Solid): Shape {
    const look = { size: [...size], pose: placeOf(pose), color: [...color] };
    return shape === 'mesh' ? { ...look, shape, mesh: this.meshPath(file) } : { ...look, shape };
  }

  private meshPath(file: string): string {
    const inPackage = /^package:\/\/[^/]+\/(.*)$/.exec(file)?.[1];
    return `${this.folder}${(inPackage ?? file).replace(/^(file:\/\/|\.\/)/, '')}`;
  }
}

/** Returns the lines of a sensor's field of view in the sensor's frame: a ring or a pyramid. */
function sightOf({ sensor }: Part): THREE.BufferGeometry | null {
  if (sensor?.kind === 'camera') {
    return pyramidOf({ fov: number(sensor.raw['fov'], 1.047), range: FARTHEST_M / 2 });
  }
  if (sensor?.kind !== 'lidar') return null;
  const fov = Math.min(number(sensor.raw['fov'], 2 * Math.PI), 2 * Math.PI);
  const isRound = fov > 2 * Math.PI - 1e-2;
  const radius = Math.min(number(sensor.raw['range_max'], 8), FARTHEST_M);
  const count = 72;
  const points = Array.from({ length: count + 1 }, (_, index) => {
    const angle = isRound ? (2 * Math.PI * index) / count : -fov / 2 + (fov * index) / count;
    return new THREE.Vector3(radius * Math.cos(angle), radius * Math.sin(angle), 0);
  });
  const center = new THREE.Vector3();
  const rim = points.flatMap((point, index) => (index === 0 ? [] : [points[index - 1] ?? point, point]));
  const rays = points.filter((_, index) => index % 6 === 0).flatMap((point) => [center, point]);
  return new THREE.BufferGeometry().setFromPoints([...rim, ...rays]);
}
