import { useComputedColorScheme } from '@mantine/core';
import { Canvas } from '@react-three/fiber';
import { IconCube3dSphere } from '@tabler/icons-react';
import { useRef, type DragEvent, type KeyboardEvent, type ReactNode } from 'react';
import type * as THREE from 'three';
import '@/features/viewer/scene/three';
import { hasWebGl, isSoftwareWebGl } from '@/features/viewer/webgl';
import type { Point } from '@/model/document/values';
import { useVisible } from '@/ui/useVisible';
import { pointAt } from './aiming';
import classes from '../editor3d.module.css';
import { DRAGGED } from '../PlaceButton';

interface EditorCanvasProps {
  readonly label: string;
  /** The text in place of the view in browsers without WebGL. */
  readonly noWebGl: string;
  readonly testId: string;
  readonly count: number;
  readonly near: number;
  readonly onKey: (event: KeyboardEvent) => void;
  /** Called when something from the palette is dropped on the view. */
  readonly onDropped: (what: unknown, at: Point | undefined) => void;
  readonly stage: (isDark: boolean) => ReactNode;
  /** The elements on top of the view. */
  readonly children: ReactNode;
}

/** The 3D view of a document: one focusable control with its own keys. */
export function EditorCanvas(props: EditorCanvasProps) {
  const view = useRef<HTMLDivElement>(null);
  const camera = useRef<THREE.Camera | null>(null);
  const isVisible = useVisible(view);
  const isDark = useComputedColorScheme('light', { getInitialValueInEffect: false }) === 'dark';
  const isSimple = isSoftwareWebGl();

  const drop = (event: DragEvent) => {
    const text = event.dataTransfer.getData(DRAGGED);
    const canvas = view.current?.querySelector('canvas');
    if (!text || !canvas || !camera.current) return;
    event.preventDefault();
    props.onDropped(JSON.parse(text), pointAt(event, canvas, camera.current) ?? undefined);
    view.current?.focus();
  };

  return (
    // The view is a single control with its own keys, like a canvas in a drawing program.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions
    <div
      ref={view}
      className={classes['view']}
      role="application"
      aria-label={props.label}
      // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
      tabIndex={0}
      data-testid={props.testId}
      data-things={props.count}
      onKeyDown={(event) => {
        if (event.target === view.current || event.target instanceof HTMLCanvasElement) props.onKey(event);
      }}
      onPointerDown={(event) => {
        if (event.target instanceof HTMLCanvasElement) view.current?.focus({ preventScroll: true });
      }}
      onDragOver={(event) => {
        if (event.dataTransfer.types.includes(DRAGGED)) event.preventDefault();
      }}
      onDrop={drop}
    >
      {hasWebGl() ? null : (
        <p className={classes['noView']} role="note">
          <IconCube3dSphere size={28} aria-hidden="true" />
          {props.noWebGl}
        </p>
      )}
      {hasWebGl() ? (
        <Canvas
          frameloop={isVisible ? 'demand' : 'never'}
          shadows={isSimple ? false : 'percentage'}
          dpr={isSimple ? 0.8 : [1, 2]}
          gl={{ antialias: !isSimple, powerPreference: 'high-performance' }}
          camera={{ fov: 45, near: props.near, far: 300, up: [0, 0, 1], position: [-4, -4, 4] }}
          onCreated={(state) => {
            camera.current = state.camera;
          }}
        >
          {props.stage(isDark)}
        </Canvas>
      ) : null}
      {props.children}
    </div>
  );
}
