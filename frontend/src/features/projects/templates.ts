import { useQuery } from '@tanstack/react-query';
import type { TFunction } from 'i18next';
import { useMemo } from 'react';
import { api } from '@/api/client';
import type { TemplateInfo } from '@/api/types';
import { translates } from '@/i18n';
import { SHELF } from './examples/shelf';

/** The order of the known templates; unknown ones follow. */
const ORDER: readonly string[] = [...SHELF.map(([id]) => id), 'empty'];

const EMPTY: TemplateInfo = { id: 'empty', name: '', description: '', conditions: [] };

function sorted(templates: readonly TemplateInfo[]): TemplateInfo[] {
  const all = templates.some(({ id }) => id === 'empty') ? [...templates] : [...templates, EMPTY];
  const place = ({ id }: TemplateInfo) => (ORDER.includes(id) ? ORDER.indexOf(id) : ORDER.length);
  return all.sort((a, b) => place(a) - place(b));
}

/** Returns templates and examples in order; until the server answers, only the empty project. */
export function useSortedTemplates(): { readonly all: readonly TemplateInfo[]; readonly isKnown: boolean } {
  const { data } = useQuery({ queryKey: ['templates'], queryFn: api.templates, staleTime: Infinity });
  const all = useMemo(() => sorted(data ?? []), [data]);
  return { all, isKnown: data !== undefined };
}

/** Returns a text of a template: the translation if there is one. */
export function templateText(
  t: TFunction<'projects'>,
  template: TemplateInfo,
  field: 'name' | 'description',
): string {
  const key = `template.${template.id}.${field}`;
  return translates(`projects:${key}`) ? t(key) : template[field];
}
