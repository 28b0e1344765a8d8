import { ColorSwatch, Switch, UnstyledButton } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { setColor, setDisabled } from '@/model/edits';
import { change } from '@/store/project/edits/blocks';
import { Section } from './Section';
import type { Target } from './target';
import classes from './Inspector.module.css';

/** The colours of blocks; a white symbol is readable on all of them in both themes. */
const COLORS = [
  '#b45309',
  '#a16207',
  '#3f7d20',
  '#0f766e',
  '#1d6fb8',
  '#6d28d9',
  '#be185d',
  '#52525b',
] as const;

/** Fields for the block's colour, and for disabling the block. */
export function LookFields({ id, node, spec }: Target) {
  const { t } = useTranslation('inspector');
  return (
    <Section title={t('look')}>
      <div className={classes['colors']} role="group" aria-label={t('color')}>
        {[null, ...COLORS].map((color) => (
          <UnstyledButton
            key={color ?? 'family'}
            aria-label={color ?? t('noColor')}
            aria-pressed={(node.color ?? null) === color}
            className={classes['swatch'] ?? ''}
            onClick={() => {
              change('color', [setColor(id, color)]);
            }}
          >
            <ColorSwatch color={color ?? `var(--bts-${spec?.family ?? 'unknown'})`} size={20} radius="sm" />
          </UnstyledButton>
        ))}
      </div>
      <Switch
        size="sm"
        label={t('disabled')}
        description={t('disabledHint')}
        checked={node.disabled ?? false}
        onChange={(event) => {
          change(event.currentTarget.checked ? 'disable' : 'enable', [
            setDisabled([id], event.currentTarget.checked),
          ]);
        }}
      />
    </Section>
  );
}
