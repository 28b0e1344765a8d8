import * as THREE from 'three';
import type { DragHandler, Drawing } from '@/features/editor3d/scene/PointerTool';
import { select, toggle } from '@/features/editor3d/editing';
import type { Point } from '@/model/document/values';
import { move } from '@/model/universe/edits';
import { positionOf } from '@/model/universe/geometry';
import { thingOf } from '@/model/universe/types';
import { placeWall } from './commands';
import { edit, readingOf, type UniverseEditor } from './editor';
import type { UniverseScene } from './UniverseScene';
import type { WallLine } from './WallLine';

/**
 * The width in m above which a thing is taken as a floor or a room, which can be dragged only if it is
 * selected.
 */
const LARGEST_M = 3;

/** Returns the handlers for dragging a universe's things with the pointer. */
export function dragHandlerOf(editor: UniverseEditor, scene: UniverseScene): DragHandler {
  const isLarge = (key: string) => {
    const size = scene.boundsOf([key]).getSize(new THREE.Vector3());
    return Math.max(size.x, size.y) > LARGEST_M;
  };
  return {
    take: (hit) => {
      const { universe } = readingOf(editor);
      const thing = universe ? thingOf(universe, hit.key) : undefined;
      if (!thing || hit.waypoint !== null) return null;
      const { selection } = editor.store.getState();
      const isSelected = selection.includes(hit.key);
      if (!isSelected && isLarge(hit.key)) return null;
      const keys = isSelected ? selection : [hit.key];
      const nodes = keys.flatMap((key) => scene.nodeOf(key) ?? []);
      return { keys, anchor: positionOf(thing), nodes };
    },
    drop: (keys, [dx, dy]) => {
      if (!keys.every((key) => editor.store.getState().selection.includes(key))) select(editor, keys);
      edit(editor, 'move', (universe) => move(universe, keys, [dx, dy, 0]));
    },
    click: (hit, isAdding) => {
      if (!hit) select(editor, []);
      else if (isAdding) toggle(editor, hit.key);
      else select(editor, [hit.key], hit.waypoint);
    },
  };
}

/** Returns the tool that draws walls from corner to corner. */
export function wallDrawing(editor: UniverseEditor, wall: WallLine): Drawing {
  let from: Point | null = null;
  return {
    isOn: () => editor.store.getState().tool === 'wall',
    height: () => 0,
    move: (point) => wall.show(from, point),
    click: (point) => {
      if (point && from) placeWall(editor, from, point);
      from = point;
    },
    end: () => {
      const wasBusy = from !== null;
      from = null;
      wall.hide();
      return wasBusy;
    },
  };
}
