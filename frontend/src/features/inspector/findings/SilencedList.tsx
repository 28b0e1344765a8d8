import { Button } from '@mantine/core';
import { IconBellOff } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { unsilence } from '@/store/project/edits/silence';
import { Section } from '../Section';
import type { Target } from '../target';
import classes from '../Inspector.module.css';

/** The findings that are silenced at the block, each with its reason, and a way back. */
export function SilencedList({ id, node, tree }: Target) {
  const { t } = useTranslation('problems');
  const silenced = Object.entries(node.silenced ?? {});
  if (silenced.length === 0) return null;
  return (
    <Section title={t('silenced.title')}>
      <ul className={classes['silenced']}>
        {silenced.map(([code, reason]) => (
          <li key={code}>
            <IconBellOff size={15} aria-hidden="true" />
            <span>
              <strong>{code}</strong> {reason}
            </span>
            <Button
              size="compact-xs"
              variant="light"
              data-testid={`unsilence-${code}`}
              onClick={() => {
                unsilence(tree, id, code);
              }}
            >
              {t('silenced.back')}
            </Button>
          </li>
        ))}
      </ul>
    </Section>
  );
}
