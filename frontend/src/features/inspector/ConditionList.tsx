import { ActionIcon, Menu } from '@mantine/core';
import { IconPlus, IconTrash } from '@tabler/icons-react';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
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

/** Scripts before and after the node's tick, in BT.CPP's script language. */
export function ConditionList({ diagram, id, node }: Target) {
  const { t } = useTranslation('inspector');
  const set = node.conditions ?? {};
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const keys = useMemo(() => [...blackboardKeys(diagram, vocabulary).keys()].sort(), [diagram, vocabulary]);
  const free = CONDITIONS.filter((name) => !(name in set));
  return (
    <Section
      title={t('conditions')}
      action={
        <Menu position="bottom-end">
          <Menu.Target>
            <ActionIcon size={24} aria-label={t('addCondition')} title={t('addCondition')}>
              <IconPlus size={15} aria-hidden="true" />
            </ActionIcon>
          </Menu.Target>
          <Menu.Dropdown>
            {free.map((name) => (
              <Menu.Item
                key={name}
                onClick={() => {
                  change('condition', [setCondition(id, name, '')]);
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
      {CONDITIONS.filter((name) => name in set).map((name) => (
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
                change('condition', [setCondition(id, name, value)], {
                  mergeKey: `condition ${id} ${name}`,
                });
              }}
            />
          </div>
          <ActionIcon
            size={24}
            aria-label={t('removeCondition', { name: t(`condition.${name}`) })}
            onClick={() => {
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
