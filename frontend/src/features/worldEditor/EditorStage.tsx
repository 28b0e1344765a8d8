import { OrbitControls } from '@react-three/drei/core/OrbitControls';
import { useThree } from '@react-three/fiber';
import { useEffect, useMemo, useRef, type ComponentRef } from 'react';
import * as THREE from 'three';
import { useStore } from 'zustand';
import { Ground } from '@/features/viewer/Ground';
import { Lights } from '@/features/viewer/Lights';
import { useThrottledInvalidate } from '@/features/viewer/useThrottledInvalidate';
import { isSoftwareWebGl } from '@/features/viewer/webgl';
import type { Universe } from '@/model/universe/types';
import { forwardOf } from './aiming';
import { isReadOnly, showIn, type UniverseEditor } from './editor';
import { EditorScene, rgba } from './EditorScene';
import { Gizmo } from './Gizmo';
import { PointerTool } from './PointerTool';
import { WallLine } from './WallLine';

interface EditorStageProps {
  readonly editor: UniverseEditor;
  readonly universe: Universe;
  readonly isDark: boolean;
}

const LOOKS = {
  light: { sky: '#e6ebf3', gridMain: '#7c8598', gridLine: '#a3abbb' },
  dark: { sky: '#151922', gridMain: '#8d96a8', gridLine: '#5b6474' },
};

/** The universe as it is written, with what moves it. */
export function EditorStage({ editor, universe, isDark }: EditorStageProps) {
  const isSimple = isSoftwareWebGl();
  const redraw = useThrottledInvalidate();
  const scene = useMemo(() => new EditorScene(isSimple, redraw), [isSimple, redraw]);
  const wall = useMemo(() => new WallLine(), []);
  const controls = useRef<ComponentRef<typeof OrbitControls>>(null);
  const gizmo = useRef<Gizmo | null>(null);
  const camera = useThree((state) => state.camera);
  const canvas = useThree((state) => state.gl.domElement);
  const root = useThree((state) => state.scene);
  const look = isDark ? LOOKS.dark : LOOKS.light;
  const { selection, waypoint, mode, tool, grid } = useStore(editor.store);

  useEffect(() => {
    const hold = (isHeld: boolean) => {
      if (controls.current) controls.current.enabled = !isHeld;
    };
    const made = new Gizmo(editor, scene, camera, canvas, { change: redraw, hold });
    made.controls.enabled = !isReadOnly();
    gizmo.current = made;
    root.add(made.root);
    const isTaken = () => made.controls.enabled && made.controls.axis !== null;
    const pointer = new PointerTool({ editor, scene, wall, camera, canvas, isTaken, hold, redraw });
    showIn(editor, {
      center: () => {
        const target = controls.current?.target ?? new THREE.Vector3();
        return [target.x, target.y];
      },
      forward: () => forwardOf(camera),
      cancel: () => made.cancel() || pointer.cancel(),
    });
    return () => {
      showIn(editor, null);
      gizmo.current = null;
      pointer.dispose();
      made.dispose();
    };
  }, [editor, scene, wall, camera, canvas, root, redraw]);
  useEffect(
    () => () => {
      scene.dispose();
      wall.dispose();
    },
    [scene, wall],
  );

  useEffect(() => {
    scene.show(universe);
    gizmo.current?.update();
    redraw();
  }, [scene, universe, redraw]);
  useEffect(() => {
    scene.mark(selection);
    if (tool !== 'wall') wall.hide();
    gizmo.current?.update();
    redraw();
  }, [scene, wall, universe, selection, waypoint, mode, tool, grid, redraw]);
  useViewpoint(editor, scene, controls);

  const lines = grid === 0 ? 1 : grid;
  return (
    <>
      <color attach="background" args={[look.sky]} />
      {isSimple ? null : <fog attach="fog" args={[look.sky, 40, 110]} />}
      <Lights
        key={universe.lights.length}
        scene={{
          lights: universe.lights.map(({ direction, intensity }) => ({
            direction: [...direction],
            intensity,
          })),
        }}
        bounds={scene.bounds}
        isDark={isDark}
        hasShadows={!isSimple}
      />
      <Ground color={rgba(universe.ground.color)} isDark={isDark} isSimple={isSimple} />
      <gridHelper
        key={look.gridMain}
        args={[40, 40, look.gridMain, look.gridLine]}
        rotation={[Math.PI / 2, 0, 0]}
        position={[0, 0, 0.004]}
        material-transparent
        material-opacity={0.5}
      />
      {lines < 1 && lines >= 0.1 ? (
        <gridHelper
          key={`${look.gridLine} ${lines}`}
          args={[20, Math.round(20 / lines), look.gridLine, look.gridLine]}
          rotation={[Math.PI / 2, 0, 0]}
          position={[0, 0, 0.0035]}
          material-transparent
          material-opacity={lines < 0.5 ? 0.14 : 0.3}
        />
      ) : null}
      <primitive object={scene.group} />
      <primitive object={wall.group} />
      <OrbitControls
        ref={controls}
        makeDefault
        maxPolarAngle={Math.PI / 2 - 0.02}
        minDistance={0.4}
        maxDistance={80}
      />
    </>
  );
}

type Controls = { readonly current: ComponentRef<typeof OrbitControls> | null };

/** Puts the camera where the user asked for it; each request is a new object. */
function useViewpoint(editor: UniverseEditor, scene: EditorScene, controls: Controls): void {
  const camera = useThree((state) => state.camera);
  const invalidate = useThree((state) => state.invalidate);
  const viewpoint = useStore(editor.store, (state) => state.viewpoint);
  useEffect(() => {
    const bounds = boundsFor(editor, scene, viewpoint.kind === 'selection');
    const center = bounds.isEmpty() ? new THREE.Vector3() : bounds.getCenter(new THREE.Vector3());
    if (viewpoint.kind !== 'selection') center.z = 0.2;
    const size = Math.min(Math.max(bounds.getSize(new THREE.Vector3()).length(), 2.5), 40);
    const before = camera.position.clone().sub(controls.current?.target ?? new THREE.Vector3());
    const offset =
      viewpoint.kind === 'top'
        ? new THREE.Vector3(-0.001, 0, size * 1.05)
        : viewpoint.kind === 'selection'
          ? before.setLength(size * 1.6)
          : new THREE.Vector3(-0.62 * size, -0.42 * size, 0.62 * size);
    camera.position.copy(center).add(offset);
    controls.current?.target.copy(center);
    controls.current?.update();
    invalidate();
  }, [editor, scene, controls, viewpoint, camera, invalidate]);
}

function boundsFor(editor: UniverseEditor, scene: EditorScene, isSelection: boolean): THREE.Box3 {
  const { selection } = editor.store.getState();
  if (!isSelection || selection.length === 0) return scene.bounds;
  const bounds = new THREE.Box3();
  for (const key of selection) {
    const node = scene.nodeOf(key);
    if (node) bounds.expandByObject(node);
  }
  return bounds;
}
