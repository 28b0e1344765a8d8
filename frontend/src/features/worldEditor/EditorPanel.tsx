import { useStore } from 'zustand';
import { thingOf, type Universe } from '@/model/universe/types';
import type { UniverseEditor } from './editor';
import { onPanelKey } from './keyboard';
import { ManyFields } from './ManyFields';
import { ThingFields } from './ThingFields';
import { ThingList } from './ThingList';
import { WorldFields } from './WorldFields';
import classes from './worldEditor.module.css';

interface EditorPanelProps {
  readonly editor: UniverseEditor;
  readonly universe: Universe;
}

/** The list of things, and the numbers of what is selected; of the world itself where nothing is. */
export function EditorPanel({ editor, universe }: EditorPanelProps) {
  const selection = useStore(editor.store, (state) => state.selection);
  const [key] = selection;
  const thing = key === undefined ? undefined : thingOf(universe, key);
  return (
    // Only undo and redo are taken here, on their way from the controls within.
    // eslint-disable-next-line jsx-a11y/no-static-element-interactions
    <div className={classes['panel']} onKeyDown={(event) => onPanelKey(editor, event)}>
      <ThingList editor={editor} universe={universe} />
      <div className={classes['fields']}>
        {selection.length > 1 ? <ManyFields editor={editor} count={selection.length} /> : null}
        {selection.length === 1 && thing ? (
          <ThingFields key={thing.key} editor={editor} universe={universe} thing={thing} />
        ) : null}
        {selection.length === 0 ? <WorldFields editor={editor} universe={universe} /> : null}
      </div>
    </div>
  );
}
