import {
  IconBox,
  IconCube,
  IconCylinder,
  IconPolygon,
  IconPuzzle,
  IconRobot,
  IconSphere,
  IconSquare,
  IconUser,
  IconWorld,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import classes from '@/features/editor3d/editor3d.module.css';
import { onPanelKey } from '@/features/editor3d/keys';
import { ThingList } from '@/features/editor3d/ThingList';
import { idProblem, rename } from '@/model/universe/edits';
import { thingOf, type Thing, type Universe } from '@/model/universe/types';
import { deleteSelected, duplicateSelected } from './commands';
import { edit, type UniverseEditor } from './editor';
import { ManyFields } from './fields/ManyFields';
import { ThingFields } from './fields/ThingFields';
import { UniverseFields } from './fields/UniverseFields';

interface UniversePanelProps {
  readonly editor: UniverseEditor;
  readonly universe: Universe;
}

const SHAPE_ICONS = {
  box: IconCube,
  cylinder: IconCylinder,
  sphere: IconSphere,
  plane: IconSquare,
  mesh: IconPuzzle,
  urdf: IconBox,
  sdf: IconBox,
};

function iconOf(thing: Thing): typeof IconBox {
  if (thing.section === 'actors') return IconUser;
  if (thing.section === 'areas') return IconPolygon;
  return thing.section === 'robots' ? IconRobot : SHAPE_ICONS[thing.shape];
}

/** The list of things, with the fields of the selected thing, or of the world itself if none is selected. */
export function UniversePanel({ editor, universe }: UniversePanelProps) {
  const { t } = useTranslation('universeEditor');
  const selection = useStore(editor.store, (state) => state.selection);
  const [key] = selection;
  const thing = key === undefined ? undefined : thingOf(universe, key);
  return (
    // The panel handles only undo and redo, when their keys bubble up from the controls inside.
    // eslint-disable-next-line jsx-a11y/no-static-element-interactions
    <div className={classes['panel']} onKeyDown={(event) => onPanelKey(editor, event)}>
      <ThingList
        editor={editor}
        title={t('things', { count: universe.things.length })}
        things={universe.things.map((each) => ({
          key: each.key,
          name: each.id || t('nameless'),
          icon: iconOf(each),
          ...('color' in each ? { color: each.color } : {}),
        }))}
        whole={{ label: t('world'), icon: IconWorld }}
        onDuplicate={() => duplicateSelected(editor)}
        onDelete={() => deleteSelected(editor)}
        nameProblem={(own, name) => {
          const problem = idProblem(universe, own, name);
          return problem ? t(`editor3d:problem.${problem}`, { id: name, most: 80 }) : null;
        }}
        onRename={(own, name) => edit(editor, 'rename', (now) => rename(now, own, name))}
      />
      <div className={classes['fields']}>
        {selection.length > 1 ? <ManyFields editor={editor} count={selection.length} /> : null}
        {selection.length === 1 && thing ? (
          <ThingFields key={thing.key} editor={editor} universe={universe} thing={thing} />
        ) : null}
        {selection.length === 0 ? <UniverseFields editor={editor} universe={universe} /> : null}
      </div>
    </div>
  );
}
