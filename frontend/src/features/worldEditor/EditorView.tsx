import { useComputedColorScheme, VisuallyHidden } from '@mantine/core';
import { Canvas } from '@react-three/fiber';
import { useRef, type DragEvent } from 'react';
import { useTranslation } from 'react-i18next';
import type * as THREE from 'three';
import { useStore } from 'zustand';
import '@/features/viewer/three';
import { isSoftwareWebGl } from '@/features/viewer/webgl';
import { positionOf } from '@/model/universe/geometry';
import { thingOf, type Universe } from '@/model/universe/types';
import { useVisible } from '@/ui/useVisible';
import { pointAt } from './aiming';
import { placeThing, type Placeable } from './commands';
import { isReadOnly, type UniverseEditor } from './editor';
import { EditorStage } from './EditorStage';
import { onEditorKey } from './keyboard';
import { DRAGGED, Palette } from './Palette';
import classes from './worldEditor.module.css';

interface EditorViewProps {
  readonly editor: UniverseEditor;
  readonly universe: Universe;
}

/** The floor plan in 3D. */
export function EditorView({ editor, universe }: EditorViewProps) {
  const { t } = useTranslation('worldEditor');
  const view = useRef<HTMLDivElement>(null);
  const camera = useRef<THREE.Camera | null>(null);
  const isVisible = useVisible(view);
  const isDark = useComputedColorScheme('light', { getInitialValueInEffect: false }) === 'dark';
  const isSimple = isSoftwareWebGl();
  const tool = useStore(editor.store, (state) => state.tool);

  const drop = (event: DragEvent) => {
    const text = event.dataTransfer.getData(DRAGGED);
    const canvas = view.current?.querySelector('canvas');
    if (!text || !canvas || !camera.current) return;
    event.preventDefault();
    const at = pointAt(event, canvas, camera.current);
    placeThing(editor, JSON.parse(text) as Placeable, at ?? undefined);
    view.current?.focus();
  };

  return (
    // The view is one control with keys of its own, like a canvas in a drawing program.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions
    <div
      ref={view}
      className={classes['view']}
      role="application"
      aria-label={t('view')}
      // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
      tabIndex={0}
      data-testid="universe-view"
      data-things={universe.things.length}
      onKeyDown={(event) => {
        if (event.target === view.current || event.target instanceof HTMLCanvasElement)
          onEditorKey(editor, event);
      }}
      onPointerDown={(event) => {
        if (event.target instanceof HTMLCanvasElement) view.current?.focus({ preventScroll: true });
      }}
      onDragOver={(event) => {
        if (event.dataTransfer.types.includes(DRAGGED)) event.preventDefault();
      }}
      onDrop={drop}
    >
      <Canvas
        frameloop={isVisible ? 'demand' : 'never'}
        shadows={isSimple ? false : 'soft'}
        dpr={isSimple ? 0.8 : [1, 2]}
        gl={{ antialias: !isSimple, powerPreference: 'high-performance' }}
        camera={{ fov: 45, near: 0.05, far: 300, up: [0, 0, 1], position: [-4, -4, 4] }}
        onCreated={(state) => {
          camera.current = state.camera;
        }}
      >
        <EditorStage editor={editor} universe={universe} isDark={isDark} />
      </Canvas>
      {isReadOnly() ? null : <Palette editor={editor} />}
      {universe.things.length === 0 ? <p className={classes['hint']}>{t('empty')}</p> : null}
      {tool === 'wall' ? <p className={classes['hint']}>{t('wallHint')}</p> : null}
      <Announcement editor={editor} universe={universe} />
    </div>
  );
}

/** Tells screen readers what is selected, and where. */
function Announcement({ editor, universe }: EditorViewProps) {
  const { t } = useTranslation('worldEditor');
  const selection = useStore(editor.store, (state) => state.selection);
  const thing = thingOf(universe, selection[0] ?? '');
  const [x, y] = thing ? positionOf(thing) : [0, 0];
  return (
    <VisuallyHidden role="status">
      {selection.length > 1 ? t('manySelected', { count: selection.length }) : null}
      {selection.length === 1 && thing ? t('selectedAt', { name: thing.id, x, y }) : null}
    </VisuallyHidden>
  );
}
