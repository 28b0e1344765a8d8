import { ActionIcon, Button, Group, Popover, TextInput, Tooltip } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { IconTag } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { Revision } from '@/api/revisions';
import { useLabel } from './useRevisions';

/** The button that gives a revision a name. */
export function LabelButton({ revision }: { readonly revision: Revision }) {
  const { t } = useTranslation('revisions');
  const [isOpen, setOpen] = useState(false);
  const [text, setText] = useState(revision.label);
  const label = useLabel();
  const keep = () => {
    setOpen(false);
    label(revision.number, text.trim()).catch((error: Error) =>
      notifications.show({ color: 'red', title: t('labelFailed'), message: error.message }),
    );
  };
  const name = t('label', { number: revision.number });
  return (
    <Popover opened={isOpen} onChange={setOpen} position="bottom-end" trapFocus returnFocus withinPortal>
      <Popover.Target>
        <Tooltip label={name}>
          <ActionIcon
            size="sm"
            aria-label={name}
            data-testid={`label-${revision.number}`}
            onClick={() => {
              setText(revision.label);
              setOpen(!isOpen);
            }}
          >
            <IconTag size={15} />
          </ActionIcon>
        </Tooltip>
      </Popover.Target>
      <Popover.Dropdown>
        <form
          onSubmit={(event) => {
            event.preventDefault();
            keep();
          }}
        >
          <Group gap="xs" align="end" wrap="nowrap">
            <TextInput
              size="xs"
              maxLength={100}
              label={t('labelField')}
              placeholder={t('labelExample')}
              value={text}
              onChange={(event) => setText(event.currentTarget.value)}
              data-autofocus
            />
            <Button size="xs" type="submit">
              {t('keep')}
            </Button>
          </Group>
        </form>
      </Popover.Dropdown>
    </Popover>
  );
}
