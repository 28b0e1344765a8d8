import { Loader, Text, Title, UnstyledButton } from '@mantine/core';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { templateText, useSortedTemplates } from '../templates';
import classes from './examples.module.css';
import { examplesOf, pictureOf, type Example, type Level } from './shelf';

interface ExampleShelfProps {
  readonly onCreate: (template: string) => void;
  /** The template from which a project is being created. */
  readonly pending: string | null;
}

/** The shelf of examples: cards by level, each with a picture of its world and a text on what it teaches. */
export function ExampleShelf({ onCreate, pending }: ExampleShelfProps) {
  const { t } = useTranslation('projects');
  const { all: templates } = useSortedTemplates();
  const examples = useMemo(() => examplesOf(templates), [templates]);
  if (examples.length === 0) return null;
  return (
    <section aria-labelledby="examples-heading">
      <Title order={2} size={18} id="examples-heading">
        {t('examples')}
      </Title>
      <Text c="dimmed" size="sm" mt={2} mb="md">
        {t('examplesHint')}
      </Text>
      <ol className={classes['shelf']}>
        {examples.map((example) => (
          <li key={example.id}>
            <ExampleCard example={example} onCreate={onCreate} pending={pending} />
          </li>
        ))}
      </ol>
    </section>
  );
}

function ExampleCard({ example, onCreate, pending }: ExampleShelfProps & { readonly example: Example }) {
  const { t } = useTranslation('projects');
  const { id, level, number, template } = example;
  const picture = pictureOf(example);
  return (
    <UnstyledButton
      className={classes['card']}
      data-testid={`new-from-${id}`}
      disabled={pending !== null}
      onClick={() => onCreate(id)}
    >
      <div className={classes['picture']}>
        {picture ? <img src={picture} alt="" loading="lazy" width={480} height={270} /> : null}
        {pending === id ? <Loader size="sm" className={classes['pending']} /> : null}
      </div>
      <div className={classes['text']}>
        <Text fw={600} size="sm">
          {number}. {templateText(t, template, 'name')}
        </Text>
        <Text size="xs" c="dimmed" className={classes['teaches']}>
          {t(`example.${id}`)}
        </Text>
        <LevelMark level={level} />
      </div>
    </UnstyledButton>
  );
}

function LevelMark({ level }: { readonly level: Level }) {
  const { t } = useTranslation('projects');
  return (
    <span className={classes['level']} data-level={level}>
      <span aria-hidden="true" className={classes['dots']}>
        {[1, 2, 3].map((dot) => (
          <span key={dot} data-filled={dot <= level || undefined} />
        ))}
      </span>
      {t(`level.${level}`)}
    </span>
  );
}
