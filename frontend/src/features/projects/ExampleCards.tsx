import { Loader, Text, UnstyledButton } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { TemplateInfo } from '@/api/types';
import classes from './projects.module.css';
import { templateText } from './templates';
import { TreePicture } from './TreePicture';

interface ExampleCardsProps {
  readonly examples: readonly TemplateInfo[];
  readonly onCreate: (template: string) => void;
  /** The template from which a project is being created. */
  readonly pending: string | null;
}

/** The shelf of examples: projects that drive a robot right away. */
export function ExampleCards({ examples, onCreate, pending }: ExampleCardsProps) {
  const { t } = useTranslation('projects');
  return (
    <div className={classes['templates']}>
      {examples.map((example) => (
        <UnstyledButton
          key={example.id}
          className={classes['template']}
          data-testid={`new-from-${example.id}`}
          disabled={pending !== null}
          onClick={() => onCreate(example.id)}
        >
          <div className={classes['templatePicture']}>
            {pending === example.id ? (
              <Loader size="sm" />
            ) : (
              <TreePicture diagram={example.root_diagram} conditions={example.conditions} />
            )}
          </div>
          <div className={classes['templateText']}>
            <Text fw={600}>{templateText(t, example, 'name')}</Text>
            <Text size="sm" c="dimmed" lineClamp={2}>
              {templateText(t, example, 'description')}
            </Text>
          </div>
        </UnstyledButton>
      ))}
    </div>
  );
}
