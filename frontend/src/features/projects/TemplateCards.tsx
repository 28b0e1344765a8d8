import { Loader, Text, UnstyledButton } from '@mantine/core';
import { IconPlus } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { TemplateInfo } from '@/api/types';
import classes from './projects.module.css';
import { TreePicture } from './TreePicture';
import { useTemplates } from './useProjects';

interface TemplateCardsProps {
  readonly onCreate: (template: string) => void;
  /** The template whose project is being made. */
  readonly pending: string | null;
}

/** Known templates keep this order; others follow. */
const ORDER = ['laser_bump_and_go', 'visual_follow_person', 'empty'];

const EMPTY: TemplateInfo = { id: 'empty', name: '', description: '' };

function sorted(templates: readonly TemplateInfo[]): TemplateInfo[] {
  const all = templates.some(({ id }) => id === 'empty') ? [...templates] : [...templates, EMPTY];
  const place = ({ id }: TemplateInfo) => (ORDER.includes(id) ? ORDER.indexOf(id) : ORDER.length);
  return all.sort((a, b) => place(a) - place(b));
}

export function TemplateCards({ onCreate, pending }: TemplateCardsProps) {
  const { t, i18n } = useTranslation('projects');
  const { data } = useTemplates();
  const textOf = (id: string, field: string, fallback: string) =>
    i18n.exists(`projects:template.${id}.${field}`) ? t(`template.${id}.${field}`) : fallback;
  return (
    <div className={classes['templates']}>
      {sorted(data ?? []).map(({ id, name, description, root_diagram }) => (
        <UnstyledButton
          key={id}
          className={classes['template']}
          data-testid={`new-from-${id}`}
          disabled={pending !== null}
          onClick={() => onCreate(id)}
        >
          <div className={classes['templatePicture']}>
            {pending === id ? <Loader size="sm" /> : null}
            {pending !== id && id === 'empty' ? <IconPlus size={30} stroke={1.5} /> : null}
            {pending !== id && id !== 'empty' ? <TreePicture diagram={root_diagram} /> : null}
          </div>
          <div className={classes['templateText']}>
            <Text fw={600}>{textOf(id, 'name', name)}</Text>
            <Text size="sm" c="dimmed" lineClamp={2}>
              {textOf(id, 'description', description)}
            </Text>
          </div>
        </UnstyledButton>
      ))}
    </div>
  );
}
