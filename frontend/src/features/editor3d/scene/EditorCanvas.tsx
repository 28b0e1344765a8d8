import { useComputedColorScheme } from '@mantine/core';
import { Canvas } from '@react-three/fiber';
import { IconCube3dSphere } from '@tabler/icons-react';
import { useCallback, useRef, useState, type KeyboardEvent, type ReactNode } from 'react';
import '@/features/viewer/scene/three';
import { FirstPicture } from '@/features/viewer/scene/FirstPicture';
import { Loading3d } from '@/features/viewer/pictures/Loading3d';
import { hasWebGl, isSoftwareWebGl } from '@/features/viewer/webgl';
import { useVisible } from '@/ui/hooks/useVisible';
import classes from '../editor3d.module.css';

interface EditorCanvasProps {
  readonly label: string;
  /** The text in place of the view in browsers without WebGL. */
  readonly noWebGl: string;
  readonly testId: string;
  readonly count: number;
  readonly near: number;
  readonly onKey: (event: KeyboardEvent) => void;
  readonly stage: (isDark: boolean) => ReactNode;
  /** The elements on top of the view. */
  readonly children: ReactNode;
}

/** The 3D view of a document: one focusable control with its own keys. */
export function EditorCanvas(props: EditorCanvasProps) {
  const view = useRef<HTMLDivElement>(null);
  const isVisible = useVisible(view);

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
    >
      {hasWebGl() ? null : (
        <p className={classes['noView']} role="note">
          <IconCube3dSphere size={28} aria-hidden="true" />
          {props.noWebGl}
        </p>
      )}
      {hasWebGl() ? <Canvas3d isVisible={isVisible} near={props.near} stage={props.stage} /> : null}
      {props.children}
    </div>
  );
}

interface Canvas3dProps {
  readonly isVisible: boolean;
  readonly near: number;
  readonly stage: (isDark: boolean) => ReactNode;
}

/** The canvas of a document in 3D; it is drawn when something changes. */
export function Canvas3d({ isVisible, near, stage }: Canvas3dProps) {
  const isDark = useComputedColorScheme('light', { getInitialValueInEffect: false }) === 'dark';
  const [isDrawn, setDrawn] = useState(false);
  const onDrawn = useCallback(() => setDrawn(true), []);
  const isSimple = isSoftwareWebGl();
  return (
    <>
      <Canvas
        frameloop={isVisible ? 'demand' : 'never'}
        shadows={isSimple ? false : 'percentage'}
        dpr={isSimple ? 0.8 : [1, 2]}
        gl={{ antialias: !isSimple, powerPreference: 'high-performance' }}
        camera={{ fov: 45, near, far: 300, up: [0, 0, 1], position: [-4, -4, 4] }}
      >
        {stage(isDark)}
        <FirstPicture onDrawn={onDrawn} />
      </Canvas>
      {isDrawn ? null : <Loading3d />}
    </>
  );
}
