import { ActionIcon, Button, Group, Menu, Modal, Textarea, Text } from '@mantine/core';
import { IconBellOff, IconDots } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { NodeId } from '@/model/diagram';
import { silence } from '@/store/project/edits/silence';

interface FindingMenuProps {
  readonly tree: string;
  readonly node: NodeId;
  readonly code: string;
  readonly message: string;
}

const LONGEST = 300;

/** The menu of a finding at a block: it is silenced there, with a reason. */
export function FindingMenu({ tree, node, code, message }: FindingMenuProps) {
  const { t } = useTranslation('problems');
  const [isOpen, setOpen] = useState(false);
  const [reason, setReason] = useState('');
  return (
    <>
      <Menu position="bottom-end" withinPortal>
        <Menu.Target>
          <ActionIcon size="sm" aria-label={t('menu', { code })} data-testid={`menu-${code}`}>
            <IconDots size={15} aria-hidden="true" />
          </ActionIcon>
        </Menu.Target>
        <Menu.Dropdown>
          <Menu.Item
            leftSection={<IconBellOff size={15} aria-hidden="true" />}
            data-testid="silence"
            onClick={() => {
              setReason('');
              setOpen(true);
            }}
          >
            {t('silence.open')}
          </Menu.Item>
        </Menu.Dropdown>
      </Menu>
      <Modal opened={isOpen} onClose={() => setOpen(false)} title={t('silence.title', { code })}>
        <form
          onSubmit={(event) => {
            event.preventDefault();
            if (reason.trim() === '') return;
            setOpen(false);
            silence(tree, node, code, reason.trim());
          }}
        >
          <Text size="sm" mb="sm">
            {message}
          </Text>
          <Textarea
            data-autofocus
            required
            autosize
            minRows={2}
            maxLength={LONGEST}
            label={t('silence.reason')}
            description={t('silence.why')}
            value={reason}
            onChange={(event) => {
              setReason(event.currentTarget.value);
            }}
          />
          <Group justify="end" mt="md">
            <Button variant="default" onClick={() => setOpen(false)}>
              {t('silence.cancel')}
            </Button>
            <Button type="submit" disabled={reason.trim() === ''}>
              {t('silence.do')}
            </Button>
          </Group>
        </form>
      </Modal>
    </>
  );
}
