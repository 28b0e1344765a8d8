import { ActionIcon, Button, Tooltip } from '@mantine/core';
import { IconPlus, IconTrash } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { removeWaypoint, setWaypoint } from '@/model/universe/edits';
import type { ActorThing, AreaThing } from '@/model/universe/types';
import { extendWay } from '../commands';
import { isReadOnly, select } from '@/features/editor3d/editing';
import { edit, type UniverseEditor } from '../editor';
import { NumberField } from '@/features/editor3d/fields';
import classes from '@/features/editor3d/editor3d.module.css';

interface PathFieldsProps {
  readonly editor: UniverseEditor;
  readonly thing: ActorThing | AreaThing;
}

/** The points of a person's path, or the corners of an area. */
export function PathFields({ editor, thing }: PathFieldsProps) {
  const { t } = useTranslation('universeEditor');
  const waypoint = useStore(editor.store, (state) => state.waypoint);
  const { key } = thing;
  const isArea = thing.section === 'areas';
  const fewest = isArea ? 3 : 1;
  return (
    <fieldset className={classes['way']}>
      <legend>{t(isArea ? 'corners' : 'way')}</legend>
      <ol>
        {thing.path.map(([x, y], index) => (
          <li key={index} data-chosen={waypoint === index || undefined}>
            <button
              type="button"
              aria-pressed={waypoint === index}
              aria-label={t(isArea ? 'corner' : 'waypoint', { number: index + 1 })}
              onClick={() => select(editor, [key], index)}
            >
              {index + 1}
            </button>
            <NumberField
              label={`x ${index + 1}`}
              value={x}
              onCommit={(value) => edit(editor, 'way', (now) => setWaypoint(now, key, index, [value, y]))}
            />
            <NumberField
              label={`y ${index + 1}`}
              value={y}
              onCommit={(value) => edit(editor, 'way', (now) => setWaypoint(now, key, index, [x, value]))}
            />
            <Tooltip label={t(isArea ? 'removeCorner' : 'removePoint')}>
              <ActionIcon
                size="sm"
                aria-label={t(isArea ? 'removeCorner' : 'removePoint')}
                disabled={thing.path.length <= fewest || isReadOnly()}
                onClick={() => {
                  edit(editor, 'way', (now) => removeWaypoint(now, key, index));
                  select(editor, [key]);
                }}
              >
                <IconTrash size={14} />
              </ActionIcon>
            </Tooltip>
          </li>
        ))}
      </ol>
      <Button
        size="compact-xs"
        variant="light"
        leftSection={<IconPlus size={13} />}
        disabled={isReadOnly()}
        data-testid="add-waypoint"
        onClick={() => extendWay(editor, key, waypoint ?? thing.path.length - 1)}
      >
        {t(isArea ? 'addCorner' : 'addPoint')}
      </Button>
    </fieldset>
  );
}
