import { Loader, Text, UnstyledButton } from '@mantine/core';
import { IconPlus } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { TemplateInfo } from '@/api/types';
import { isExample } from './examples/shelf';
import classes from './projects.module.css';
import { templateText, useSortedTemplates } from './templates';
import { TreePicture } from './TreePicture';

interface TemplateCardsProps {
  readonly onCreate: (template: string) => void;
  /** The template from which a project is being created. */
  readonly pending: string | null;
}

/** The templates that are no examples: the empty project, and those of the server. */
export function TemplateCards({ onCreate, pending }: TemplateCardsProps) {
  const { t } = useTranslation('projects');
  const templates = useSortedTemplates().filter(({ id }) => !isExample(id));
  return (
    <div className={classes['templates']}>
      {templates.map((template) => (
        <UnstyledButton
          key={template.id}
          className={classes['template']}
          data-testid={`new-from-${template.id}`}
          disabled={pending !== null}
          onClick={() => onCreate(template.id)}
        >
          <div className={classes['templatePicture']}>
            <Picture template={template} isPending={pending === template.id} />
          </div>
          <div className={classes['templateText']}>
            <Text fw={600}>{templateText(t, template, 'name')}</Text>
            <Text size="sm" c="dimmed" lineClamp={2}>
              {templateText(t, template, 'description')}
            </Text>
          </div>
        </UnstyledButton>
      ))}
    </div>
  );
}

function Picture({ template, isPending }: { readonly template: TemplateInfo; readonly isPending: boolean }) {
  if (isPending) return <Loader size="sm" />;
  if (template.id === 'empty') return <IconPlus size={30} stroke={1.5} />;
  return <TreePicture diagram={template.root_diagram} />;
}
