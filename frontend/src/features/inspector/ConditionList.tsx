import { ActionIcon, Menu } from '@mantine/core';
import { IconPlus, IconTrash } from '@tabler/icons-react';
import { useMemo, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { NodeId } from '@/model/diagram';
import { setCondition } from '@/model/edits';
import { blackboardKeys } from '@/model/vocabulary';
import { useProjectStore } from '@/store/project';
import { change } from '@/store/project/edits/blocks';
import { ScriptInput } from './ScriptInput';
import { Section } from './Section';
import type { Target } from './target';
import classes from './Inspector.module.css';

const CONDITIONS = [
  '_skipIf',
  '_failureIf',
  '_successIf',
  '_while',
  '_onSuccess',
  '_onFailure',
  '_onHalted',
  '_post',
] as const;

type Condition = (typeof CONDITIONS)[number];

/**
 * Returns the condition that was just added, until the user leaves its field. While the field is empty, the
 * tree does not contain the condition, so that no empty script is reported.
 */
function useNewCondition(id: NodeId) {
  const [added, setAdded] = useState<{ readonly id: NodeId; readonly name: Condition } | null>(null);
  const name = added?.id === id ? added.name : null;
  // A reference, since the focus leaves a field before the page renders without it.
  const isOpen = useRef(false);
  return {
    name,
    add: (condition: Condition) => {
      isOpen.current = true;
      setAdded({ id, name: condition });
    },
    end: () => {
      isOpen.current = false;
      setAdded(null);
    },
    isOpen: () => isOpen.current,
  };
}

/** Fields for the scripts before and after the node's tick, in BT.CPP's script language. */
export function ConditionList({ diagram, id, node }: Target) {
  const { t } = useTranslation('inspector');
  const set = node.conditions ?? {};
  const fresh = useNewCondition(id);
  const adder = useRef<HTMLButtonElement>(null);
  const write = (name: Condition, value: string | null) => {
    change('condition', [setCondition(id, name, value)], { mergeKey: `condition ${id} ${name}` });
  };
  const cancel = () => {
    fresh.end();
    adder.current?.focus();
  };
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const keys = useMemo(() => [...blackboardKeys(diagram, vocabulary).keys()].sort(), [diagram, vocabulary]);
  const free = CONDITIONS.filter((name) => !(name in set) && name !== fresh.name);
  return (
    <Section
      title={t('conditions')}
      action={
        <Menu position="bottom-end" returnFocus={false}>
          <Menu.Target>
            <ActionIcon ref={adder} size={24} aria-label={t('addCondition')} title={t('addCondition')}>
              <IconPlus size={15} aria-hidden="true" />
            </ActionIcon>
          </Menu.Target>
          <Menu.Dropdown>
            {free.map((name) => (
              <Menu.Item
                key={name}
                onClick={() => {
                  fresh.add(name);
                }}
                rightSection={<code className={classes['code']}>{name}</code>}
              >
                {t(`condition.${name}`)}
              </Menu.Item>
            ))}
          </Menu.Dropdown>
        </Menu>
      }
    >
      {CONDITIONS.filter((name) => name in set || name === fresh.name).map((name) => (
        <div key={name} className={classes['condition']}>
          <div className={classes['grow']}>
            <span className={classes['conditionName']}>
              {t(`condition.${name}`)} <code className={classes['code']}>{name}</code>
            </span>
            <ScriptInput
              label={t(`condition.${name}`)}
              testId={`condition-${name}`}
              value={set[name] ?? ''}
              keys={keys}
              onChange={(value) => {
                write(name, name === fresh.name && value.trim() === '' ? null : value);
              }}
              {...(name === fresh.name
                ? {
                    isNew: true,
                    onLeave: () => {
                      if (fresh.isOpen() && !(name in set)) write(name, '');
                      fresh.end();
                    },
                    onCancel: cancel,
                  }
                : {})}
            />
          </div>
          <ActionIcon
            size={24}
            aria-label={t('removeCondition', { name: t(`condition.${name}`) })}
            onClick={() => {
              if (name === fresh.name) fresh.end();
              change('condition', [setCondition(id, name, null)]);
            }}
          >
            <IconTrash size={14} aria-hidden="true" />
          </ActionIcon>
        </div>
      ))}
    </Section>
  );
}
