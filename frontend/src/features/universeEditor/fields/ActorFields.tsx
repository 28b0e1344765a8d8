import { ActionIcon, Button, Switch, Tooltip } from '@mantine/core';
import { IconPlus, IconTrash } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { removeWaypoint, setField, setWaypoint } from '@/model/universe/edits';
import type { Json } from '@/model/document/values';
import type { ActorThing } from '@/model/universe/types';
import { extendWay } from '../commands';
import { isReadOnly, select } from '@/features/editor3d/editing';
import { edit, type UniverseEditor } from '../editor';
import { ColorField, FieldGroup, NumberField } from '@/features/editor3d/fields';
import classes from '@/features/editor3d/editor3d.module.css';

interface ActorFieldsProps {
  readonly editor: UniverseEditor;
  readonly thing: ActorThing;
}

export function ActorFields({ editor, thing }: ActorFieldsProps) {
  const { t } = useTranslation('universeEditor');
  const { key } = thing;
  const waypoint = useStore(editor.store, (state) => state.waypoint);
  const set = (field: string, value: Json, mergeKey?: string) =>
    edit(
      editor,
      field,
      (now) => setField(now, key, field, value),
      mergeKey === undefined ? {} : { mergeKey },
    );
  return (
    <>
      <ColorField
        label={t('clothes')}
        value={thing.color}
        onChange={(color) => set('color', color, `color ${key}`)}
        onEnd={() => select(editor, [key], waypoint)}
      />
      <FieldGroup title={t('walk')} columns={2}>
        <NumberField
          label={t('speed')}
          value={thing.speed}
          min={0}
          max={5}
          onCommit={(value) => set('speed', value)}
        />
        <NumberField
          label={t('start_m')}
          value={thing.start_m}
          min={0}
          onCommit={(value) => set('start_m', value)}
        />
        <Switch
          size="xs"
          label={t('loop')}
          checked={thing.loop}
          disabled={isReadOnly()}
          onChange={(event) => set('loop', event.currentTarget.checked)}
        />
      </FieldGroup>
      <fieldset className={classes['way']}>
        <legend>{t('way')}</legend>
        <ol>
          {thing.path.map(([x, y], index) => (
            <li key={index} data-chosen={waypoint === index || undefined}>
              <button
                type="button"
                aria-pressed={waypoint === index}
                aria-label={t('waypoint', { number: index + 1 })}
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
              <Tooltip label={t('removePoint')}>
                <ActionIcon
                  size="sm"
                  aria-label={t('removePoint')}
                  disabled={thing.path.length < 2 || isReadOnly()}
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
          {t('addPoint')}
        </Button>
      </fieldset>
    </>
  );
}
