import { Button, Group, Text, TextInput } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { evaluationPath, firstEvaluation, isEvaluationName } from '@/model/evaluation/files';
import { useProjectStore } from '@/store/project';
import classes from './evaluate.module.css';

interface Props {
  readonly names: readonly string[];
  readonly mayMake: boolean;
  readonly onMade: (name: string) => void;
  /** null: there is nothing to go back to. */
  readonly onCancel: (() => void) | null;
}

const DEFAULT = 'room';
const UNIVERSE = 'walled_room';

/** Makes an evaluation of a name, with values that can be run at once. */
export function NewEvaluation({ names, mayMake, onMade, onCancel }: Props) {
  const { t } = useTranslation('evaluate');
  const universe = useProjectStore((state) => state.settings?.universe);
  const addFile = useProjectStore((state) => state.addFile);
  const [name, setName] = useState(names.includes(DEFAULT) ? '' : DEFAULT);
  const field = useRef<HTMLInputElement>(null);
  const isAsked = onCancel !== null;
  useEffect(() => {
    if (isAsked) field.current?.focus();
  }, [isAsked]);
  const problem = !isEvaluationName(name) ? t('new.badName') : names.includes(name) ? t('new.taken') : '';
  const isPossible = universe !== 'none';
  if (!mayMake || !isPossible) {
    return <Text size="sm">{t(isPossible ? 'new.viewer' : 'new.noWorld')}</Text>;
  }
  return (
    <form
      className={classes['form']}
      onSubmit={(event) => {
        event.preventDefault();
        if (problem) return;
        addFile(evaluationPath(name), firstEvaluation(universe ?? UNIVERSE));
        onMade(name);
      }}
    >
      <Text size="sm">{t('new.what')}</Text>
      <TextInput
        ref={field}
        size="xs"
        label={t('new.name')}
        value={name}
        maxLength={60}
        error={name === '' ? '' : problem}
        onChange={({ currentTarget: { value } }) => setName(value)}
      />
      <Group gap={6}>
        <Button type="submit" size="xs" disabled={problem !== ''}>
          {t('new.make')}
        </Button>
        {onCancel ? (
          <Button size="xs" variant="default" onClick={onCancel}>
            {t('new.cancel')}
          </Button>
        ) : null}
      </Group>
    </form>
  );
}
