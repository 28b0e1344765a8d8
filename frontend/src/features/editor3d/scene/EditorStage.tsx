import { useThree } from '@react-three/fiber';
import { useEffect, useRef, type ReactNode } from 'react';
import * as THREE from 'three';
import { useStore } from 'zustand';
import type { Scene } from '@/generated/messages';
import { Surroundings, useSight, type Orbit } from '@/features/viewer/scene/Surroundings';
import type { Pictures } from '@/features/viewer/scene/TextureCache';
import { useThrottledInvalidate } from '@/features/viewer/useThrottledInvalidate';
import { forwardOf } from './aiming';
import type { Point } from '@/model/document/values';
import { Gizmo, type Handles } from './Gizmo';
import { PlacingTool, type Placement } from './PlacingTool';
import { PointerTool, type DragHandler, type Drawing } from './PointerTool';
import { isReadOnly, showIn, type Editor } from '../editing';
import type { ThingScene } from './ThingScene';

/** The smallest distance of grid lines in m; denser lines would blur. */
const FINEST_LINES_M = 0.05;

/** The parts that connect an editor with its stage: the drawn things, and the handlers of gestures. */
export interface Staged {
  readonly scene: ThingScene<{ readonly key: string }>;
  readonly handles: Handles;
  readonly dragHandler: DragHandler;
  readonly placement: Placement;
  readonly drawing?: Drawing;
}

interface EditorStageProps {
  readonly editor: Editor;
  readonly staged: Staged;
  /** The document; a new object is drawn again. */
  readonly content: object;
  readonly isDark: boolean;
  readonly lights: Scene['lights'];
  readonly ground: { readonly color: readonly number[]; readonly picture?: string | undefined };
  readonly textures?: Pictures | undefined;
  /** The smallest and the largest distance of the camera in m, and the limits of the visible size in m. */
  readonly reach: readonly [number, number];
  readonly extent: readonly [number, number];
  readonly children?: ReactNode;
}

/** The 3D content of a document, with the tools that move its things. */
export function EditorStage(props: EditorStageProps) {
  const { editor, staged, content, isDark, lights, ground, textures, reach, extent } = props;
  const { scene, handles, dragHandler, placement, drawing } = staged;
  const redraw = useThrottledInvalidate();
  const controls = useRef<Orbit | null>(null);
  const gizmo = useRef<Gizmo | null>(null);
  const placer = useRef<PlacingTool | null>(null);
  const camera = useThree((state) => state.camera);
  const canvas = useThree((state) => state.gl.domElement);
  const root = useThree((state) => state.scene);
  const { selection, waypoint, mode, tool, placing, grid, viewpoint } = useStore(editor.store);

  useEffect(() => {
    const hold = (isHeld: boolean) => {
      if (controls.current) controls.current.enabled = !isHeld;
    };
    const made = new Gizmo(handles, camera, canvas, { change: redraw, hold });
    made.controls.enabled = !isReadOnly();
    gizmo.current = made;
    root.add(made.root);
    const isTaken = () => made.controls.enabled && made.controls.axis !== null;
    const placingTool = new PlacingTool({ editor, placement, camera, canvas, redraw });
    placer.current = placingTool;
    const drawings = drawing ? [placingTool, drawing] : [placingTool];
    const view = { camera, canvas, isTaken, hold, redraw };
    const pointer = new PointerTool({ editor, scene, dragHandler, drawings, ...view });
    const handle = {
      center: (): Point => {
        const target = controls.current?.target ?? new THREE.Vector3();
        return [target.x, target.y];
      },
      forward: () => forwardOf(camera),
      cancel: () => made.cancel() || pointer.cancel(),
    };
    showIn(editor, handle, placingTool);
    // The thing was chosen while the view was still loading.
    if (editor.store.getState().placing) placingTool.focus();
    return () => {
      showIn(editor, null);
      gizmo.current = null;
      placer.current = null;
      pointer.dispose();
      made.dispose();
    };
  }, [editor, scene, handles, dragHandler, placement, drawing, camera, canvas, root, redraw]);

  useEffect(() => {
    handles.show();
    gizmo.current?.update();
    redraw();
  }, [handles, content, redraw]);
  useEffect(() => {
    placer.current?.show();
  }, [placing]);
  useEffect(() => {
    scene.mark(selection);
    if (tool !== 'wall') drawing?.end();
    gizmo.current?.update();
    redraw();
  }, [scene, drawing, content, selection, waypoint, mode, tool, placing, grid, redraw]);
  useSight(controls, viewpoint, () => {
    const { kind } = viewpoint;
    const isSelection = kind === 'selection' && editor.store.getState().selection.length > 0;
    const bounds = isSelection ? scene.boundsOf(editor.store.getState().selection) : scene.bounds;
    return { bounds, kind, least: extent[0], most: extent[1] };
  });

  return (
    <Surroundings
      controls={controls}
      isDark={isDark}
      lights={lights}
      bounds={scene.bounds}
      ground={ground}
      textures={textures}
      hasGrid
      fineGrid={grid === 0 ? 0 : Math.max(grid, FINEST_LINES_M)}
      reach={reach}
    >
      <primitive object={scene.group} />
      <primitive object={placement.scene.group} />
      {props.children}
    </Surroundings>
  );
}
