import * as THREE from 'three';
import type { Shape } from '@/generated/messages';

const GREY = [0.6, 0.62, 0.66, 1];
const MOST_LINKS = 500;

/**
 * Returns the visible shapes of a URDF with every joint at zero, in the frame of its root link; mesh names
 * stay as in the file. Null for a text that is not a URDF.
 */
export function urdfShapes(text: string): Shape[] | null {
  const document = new DOMParser().parseFromString(text, 'text/xml');
  const robot = document.querySelector(':root');
  if (document.querySelector('parsererror') || robot?.tagName !== 'robot') return null;
  const links = new Map(childrenOf(robot, 'link').map((link) => [link.getAttribute('name') ?? '', link]));
  const joints = childrenOf(robot, 'joint').map((joint) => ({
    parent: childrenOf(joint, 'parent')[0]?.getAttribute('link') ?? '',
    child: childrenOf(joint, 'child')[0]?.getAttribute('link') ?? '',
    at: originOf(joint),
  }));
  const colors = colorsOf(robot);
  const roots = [...links.keys()].filter((name) => !joints.some(({ child }) => child === name));
  const shapes: Shape[] = [];
  const queue = roots.map((name) => ({ name, at: new THREE.Matrix4() }));
  for (let count = 0; queue.length > 0 && count < MOST_LINKS; count += 1) {
    const { name, at } = queue.shift() ?? { name: '', at: new THREE.Matrix4() };
    const link = links.get(name);
    if (link)
      for (const visual of childrenOf(link, 'visual')) shapes.push(...visualShapes(visual, at, colors));
    for (const joint of joints) {
      if (joint.parent === name) queue.push({ name: joint.child, at: at.clone().multiply(joint.at) });
    }
  }
  return shapes;
}

const childrenOf = (parent: Element, tag: string): Element[] =>
  [...parent.children].filter((child) => child.tagName === tag);

function numbers(text: string | null | undefined, fallback: readonly number[]): number[] {
  const parts = (text ?? '').trim().split(/\s+/).map(Number);
  return parts.length === fallback.length && parts.every(Number.isFinite) ? parts : [...fallback];
}

function originOf(element: Element): THREE.Matrix4 {
  const origin = childrenOf(element, 'origin')[0];
  const [x = 0, y = 0, z = 0] = numbers(origin?.getAttribute('xyz'), [0, 0, 0]);
  const [roll = 0, pitch = 0, yaw = 0] = numbers(origin?.getAttribute('rpy'), [0, 0, 0]);
  const turn = new THREE.Matrix4().makeRotationFromEuler(new THREE.Euler(roll, pitch, yaw, 'ZYX'));
  return turn.setPosition(x, y, z);
}

function colorsOf(robot: Element): Map<string, number[]> {
  return new Map(
    childrenOf(robot, 'material').map((material) => [material.getAttribute('name') ?? '', colorOf(material)]),
  );
}

const colorOf = (material: Element): number[] =>
  numbers(childrenOf(material, 'color')[0]?.getAttribute('rgba'), GREY);

function visualShapes(visual: Element, link: THREE.Matrix4, colors: Map<string, number[]>): Shape[] {
  const geometry = childrenOf(visual, 'geometry')[0]?.firstElementChild;
  if (!geometry) return [];
  const material = childrenOf(visual, 'material')[0];
  const own = material && childrenOf(material, 'color').length > 0 ? colorOf(material) : undefined;
  const color = own ?? colors.get(material?.getAttribute('name') ?? '') ?? GREY;
  const position = new THREE.Vector3();
  const turn = new THREE.Quaternion();
  link.clone().multiply(originOf(visual)).decompose(position, turn, new THREE.Vector3());
  const pose = [...position.toArray(), ...turn.toArray()];
  const number = (name: string) => numbers(geometry.getAttribute(name), [0.1])[0] ?? 0.1;
  switch (geometry.tagName) {
    case 'box':
      return [{ shape: 'box', size: numbers(geometry.getAttribute('size'), [0.1, 0.1, 0.1]), pose, color }];
    case 'cylinder':
    case 'capsule':
      return [{ shape: geometry.tagName, size: [number('radius'), number('length')], pose, color }];
    case 'sphere':
      return [{ shape: 'sphere', size: [number('radius')], pose, color }];
    case 'mesh': {
      const size = numbers(geometry.getAttribute('scale'), [1, 1, 1]);
      return [{ shape: 'mesh', size, pose, color, mesh: geometry.getAttribute('filename') ?? '' }];
    }
    default:
      return [];
  }
}
