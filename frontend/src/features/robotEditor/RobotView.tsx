import { VisuallyHidden } from '@mantine/core';
import { useEffect, useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { EditorCanvas } from '@/features/editor3d/scene/EditorCanvas';
import { PlacingHint } from '@/features/editor3d/PlacingHint';
import { GHOST_OPACITY } from '@/features/editor3d/scene/PlacingTool';
import { EditorStage } from '@/features/editor3d/scene/EditorStage';
import { onEditorKey, type KeyActs } from '@/features/editor3d/keys';
import { isReadOnly, TURN_STEP } from '@/features/editor3d/editing';
import { useThrottledInvalidate } from '@/features/viewer/useThrottledInvalidate';
import { isSoftwareWebGl } from '@/features/viewer/webgl';
import { readable } from '@/model/document/readable';
import { partOf, type Robot } from '@/model/robot/types';
import { duplicateSelected, nudge, removeSelected, turnSelected } from './commands';
import { readingOf, type RobotEditor } from './editor';
import { dragHandlerOf, handlesOf } from './gestures';
import { urdfFolder } from './meshes';
import { placementOf } from './placement';
import { RobotPalette } from './RobotPalette';
import { RobotScene } from './RobotScene';

interface RobotViewProps {
  readonly editor: RobotEditor;
  readonly robot: Robot;
}

/** Returns the keys of the view, as listed in `docs/how-to/make-a-robot.md`. */
const keysOf = (editor: RobotEditor): KeyActs => ({
  modes: ['move', 'turn'],
  nudge: (along, aside, up, factor) => nudge(editor, along, aside, up, factor),
  turn: (sense) => turnSelected(editor, sense * TURN_STEP),
  remove: () => removeSelected(editor),
  duplicate: () => duplicateSelected(editor),
  all: () => readingOf(editor).robot?.parts.map(({ key }) => key) ?? [],
});

/** The 3D view of the robot, with all joints at zero. */
export function RobotView({ editor, robot }: RobotViewProps) {
  const { t } = useTranslation('robotEditor');
  const selection = useStore(editor.store, (state) => state.selection);
  const part = partOf(robot, selection[0] ?? '');
  const [x, y, z] = part?.pose ?? [0, 0, 0];
  return (
    <EditorCanvas
      label={`${robot.name}. ${t('view')}`}
      noWebGl={t('noWebGl')}
      testId="robot-view"
      count={robot.parts.length}
      near={0.01}
      onKey={(event) => onEditorKey(editor, event, keysOf(editor))}
      stage={(isDark) => <RobotStage editor={editor} robot={robot} isDark={isDark} />}
    >
      {isReadOnly() ? null : <RobotPalette editor={editor} />}
      <PlacingHint editor={editor} />
      <VisuallyHidden role="status">
        {selection.length > 1 ? t('manySelected', { count: selection.length }) : null}
        {selection.length === 1 && part
          ? t('selectedAt', { name: part.name, x: readable(x), y: readable(y), z: readable(z) })
          : null}
      </VisuallyHidden>
    </EditorCanvas>
  );
}

const GROUND = { color: [0.85, 0.83, 0.8] };
const SUN = [{ direction: [0.3, 0.4, -0.8], intensity: 1 }];

function RobotStage({ editor, robot, isDark }: RobotViewProps & { readonly isDark: boolean }) {
  const isSimple = isSoftwareWebGl();
  const redraw = useThrottledInvalidate();
  const folder = urdfFolder(editor);
  const scene = useMemo(() => new RobotScene(isSimple, redraw, folder), [isSimple, redraw, folder]);
  const ghost = useMemo(
    () => new RobotScene(isSimple, redraw, folder, GHOST_OPACITY),
    [isSimple, redraw, folder],
  );
  const staged = useMemo(
    () => ({
      scene,
      handles: handlesOf(editor, scene),
      dragHandler: dragHandlerOf(editor, scene),
      placement: placementOf(editor, ghost),
    }),
    [editor, scene, ghost],
  );
  useEffect(
    () => () => {
      scene.dispose();
      ghost.dispose();
    },
    [scene, ghost],
  );
  return (
    <EditorStage
      editor={editor}
      staged={staged}
      content={robot}
      isDark={isDark}
      lights={SUN}
      ground={GROUND}
      reach={[0.1, 12]}
      extent={[0.55, 6]}
    />
  );
}
