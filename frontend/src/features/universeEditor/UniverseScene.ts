import * as THREE from 'three';
import { setThingPose } from '@/features/editor3d/scene/Gizmo';
import { arrow, box, floorOf, frameOf, wayOf } from '@/features/editor3d/scene/marks';
import { arrival, rgba, ThingScene } from '@/features/editor3d/scene/ThingScene';
import {
  hasPath,
  type ActorThing,
  type ModelThing,
  type RobotThing,
  type Thing,
  type Universe,
} from '@/model/universe/types';
import { personShapes } from './person';
import { pictureName, type EditorTextures } from './textures';

const HERE = [0, 0, 0, 0, 0, 0, 1];
const UNKNOWN = [0.6, 0.62, 0.66, 0.5];

/** The three.js objects of a universe's things. */
export class UniverseScene extends ThingScene<Thing> {
  constructor(
    isSimple: boolean,
    onArrival: () => void,
    private readonly textures: EditorTextures,
    opacity = 1,
  ) {
    super(isSimple, onArrival, textures, opacity);
    // A textured thing is built again once the size of its picture is known.
    textures.onArrival = () => this.again();
  }

  showUniverse(universe: Universe): void {
    this.show(universe.things);
  }

  protected stateOf(thing: Thing): unknown {
    if (thing.section === 'robots') return this.arrivals(this.assets.robot(thing.model));
    if (hasPath(thing)) return '';
    const isPainted = thing.texture !== '' && this.textures.has(pictureName(thing.texture, thing.tile));
    if (thing.shape === 'mesh') return [arrival(this.assets.mesh(thing.file)), isPainted];
    if (thing.texture) return isPainted;
    return thing.shape === 'urdf' ? this.arrivals(this.assets.model(thing.file)) : '';
  }

  protected fill(node: THREE.Group, thing: Thing): void {
    if (thing.section === 'models') this.addModel(node, thing);
    else if (thing.section === 'actors') this.addActor(node, thing);
    else if (thing.section === 'areas') node.add(...floorOf(thing.path));
    else this.addRobot(node, thing);
  }

  protected put(node: THREE.Group, thing: Thing): void {
    if (hasPath(thing)) node.position.set(0, 0, 0);
    else setThingPose(node, thing.pose);
  }

  private addModel(node: THREE.Group, thing: ModelThing): void {
    const { shape, size } = thing;
    const texture = pictureName(thing.texture, thing.tile);
    const look = { size: [...size], pose: HERE, color: rgba(thing.color), texture };
    if (shape === 'mesh') this.addMesh(node, { ...look, shape, mesh: thing.file });
    else if (shape === 'urdf') this.addShapes(node, this.assets.model(thing.file), 0.5);
    else if (shape === 'sdf') node.add(box(0.5, UNKNOWN));
    else node.add(this.meshOf({ ...look, shape }));
    node.add(frameOf(node));
  }

  private addRobot(node: THREE.Group, thing: RobotThing): void {
    this.addShapes(node, this.assets.robot(thing.model), 0.35);
    node.add(frameOf(node), arrow());
  }

  private addActor(node: THREE.Group, thing: ActorThing): void {
    const person = new THREE.Group();
    for (const shape of personShapes(rgba(thing.color))) person.add(this.meshOf(shape));
    const [[x, y] = [0, 0], next] = thing.path;
    person.position.set(x, y, 0);
    if (next) person.rotation.z = Math.atan2(next[1] - y, next[0] - x);
    person.add(frameOf(person));
    node.add(person, ...wayOf(thing));
    // The frame surrounds the person, not the whole path.
    const frame = person.children.at(-1);
    if (frame) node.attach(frame);
  }
}
