import { VisuallyHidden } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import classes from '@/features/editor3d/editor3d.module.css';
import { EditorCanvas } from '@/features/editor3d/scene/EditorCanvas';
import { onEditorKey } from '@/features/editor3d/keys';
import { PlacingHint } from '@/features/editor3d/PlacingHint';
import { isReadOnly } from '@/features/editor3d/editing';
import { readable } from '@/model/document/readable';
import { positionOf } from '@/model/universe/geometry';
import { thingOf, type Universe } from '@/model/universe/types';
import type { UniverseEditor } from './editor';
import { keysOf } from './keyboard';
import { Palette } from './Palette';
import { UniverseStage } from './UniverseStage';

interface UniverseViewProps {
  readonly editor: UniverseEditor;
  readonly universe: Universe;
}

/** The 3D view of the universe, as a floor plan. */
export function UniverseView({ editor, universe }: UniverseViewProps) {
  const { t } = useTranslation('universeEditor');
  const tool = useStore(editor.store, (state) => state.tool);
  const isPlacing = useStore(editor.store, ({ placing }) => placing !== null);
  return (
    <EditorCanvas
      label={`${universe.name}. ${t('view')}`}
      noWebGl={t('noWebGl')}
      testId="universe-view"
      count={universe.things.length}
      near={0.05}
      onKey={(event) => onEditorKey(editor, event, keysOf(editor))}
      stage={(isDark) => <UniverseStage editor={editor} universe={universe} isDark={isDark} />}
    >
      {isReadOnly() ? null : <Palette editor={editor} />}
      {universe.things.length === 0 && !isPlacing ? <p className={classes['hint']}>{t('empty')}</p> : null}
      <PlacingHint editor={editor} />
      {tool === 'wall' ? <p className={classes['hint']}>{t('wallHint')}</p> : null}
      <Announcement editor={editor} universe={universe} />
    </EditorCanvas>
  );
}

/** The announcement of the selected things and their positions for screen readers. */
function Announcement({ editor, universe }: UniverseViewProps) {
  const { t } = useTranslation('universeEditor');
  const selection = useStore(editor.store, (state) => state.selection);
  const thing = thingOf(universe, selection[0] ?? '');
  const [x, y] = thing ? positionOf(thing) : [0, 0];
  return (
    <VisuallyHidden role="status">
      {selection.length > 1 ? t('manySelected', { count: selection.length }) : null}
      {selection.length === 1 && thing
        ? t('selectedAt', { name: thing.id, x: readable(x), y: readable(y) })
        : null}
    </VisuallyHidden>
  );
}
