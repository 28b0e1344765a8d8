import { Loader, Text, UnstyledButton } from '@mantine/core';
import { IconPlus } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { TemplateInfo } from '@/api/types';
import classes from './projects.module.css';
import { templateText } from './templates';

interface TemplateCardsProps {
  readonly templates: readonly TemplateInfo[];
  readonly onCreate: (template: string) => void;
  /** The template from which a project is being created. */
  readonly pending: string | null;
}

/** The cards of templates: starting points, which do nothing by themselves. */
export function TemplateCards({ templates, onCreate, pending }: TemplateCardsProps) {
  const { t } = useTranslation('projects');
  return (
    <div className={classes['templates']}>
      {templates.map((template) => (
        <UnstyledButton
          key={template.id}
          className={classes['beginning']}
          data-testid={`new-from-${template.id}`}
          disabled={pending !== null}
          onClick={() => onCreate(template.id)}
        >
          <span className={classes['beginningIcon']}>
            {pending === template.id ? <Loader size="sm" /> : <IconPlus size={22} stroke={1.6} />}
          </span>
          <span>
            <Text fw={600} span display="block">
              {templateText(t, template, 'name')}
            </Text>
            <Text size="sm" c="dimmed" lineClamp={2} span>
              {templateText(t, template, 'description')}
            </Text>
          </span>
        </UnstyledButton>
      ))}
    </div>
  );
}
