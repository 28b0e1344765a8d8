import { useTranslation } from 'react-i18next';
import { shippedDoc } from '@/i18n/shipped';
import type { NodeSpec } from '@/model/vocabulary';
import { Section } from './Section';
import classes from './Inspector.module.css';

function childrenText({ minChildren: min, maxChildren: max }: NodeSpec): string {
  if (max === Infinity) return `${min}+`;
  return min === max ? String(min) : `${min}–${max}`;
}

/** The description of the node, from the catalogue or the action's docstring. */
export function NodeDocs({ spec }: { readonly spec: NodeSpec | undefined }) {
  const { t } = useTranslation('inspector');
  if (!spec?.summary) return null;
  return (
    <Section title={t('doc')}>
      <p className={classes['doc']}>{shippedDoc(spec.type, spec.summary)}</p>
      {spec.maxChildren > 0 && (
        <p className={classes['none']}>{t('children', { text: childrenText(spec) })}</p>
      )}
    </Section>
  );
}
