import { Button, Group, Modal, Radio, Stack, Text } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { ChildOrder } from '@/api/client';
import { findingText } from '@/ui/findingText';
import type { OrderOffer } from './useImport';

interface Props {
  readonly offer: OrderOffer;
  readonly onChoose: (order: ChildOrder) => void;
  readonly onClose: () => void;
}

/** A dialogue that asks in which order children run, where the project's own order leaves a branch out. */
export function OrderDialog({ offer, onChoose, onClose }: Props) {
  const { t } = useTranslation('projects');
  const { values } = offer.finding;
  const [own, other] = [values?.['order'] as ChildOrder, values?.['other'] as ChildOrder];
  const [order, setOrder] = useState(other);
  // Within a sentence.
  const words = (each: ChildOrder) => t(`order.of.${each}`).replace(/^./, (first) => first.toLowerCase());
  return (
    <Modal opened onClose={onClose} title={t('order.title')} size="lg">
      <Text size="sm" mb="md">
        {
          findingText({ ...offer.finding, values: { ...values, order: words(own), other: words(other) } })
            .message
        }
      </Text>
      <Radio.Group
        value={order}
        onChange={(value) => setOrder(value as ChildOrder)}
        label={t('order.text', { file: offer.asked.file.name })}
        mb="md"
      >
        <Stack gap="xs" mt="xs">
          <Radio value={other} label={t(`order.of.${other}`)} description={t('order.other')} data-autofocus />
          <Radio value={own} label={t(`order.of.${own}`)} description={t('order.own')} />
        </Stack>
      </Radio.Group>
      <Group justify="end">
        <Button variant="default" onClick={onClose}>
          {t('repair.decline')}
        </Button>
        <Button onClick={() => onChoose(order)} data-testid="choose-order">
          {t('mainTree.accept')}
        </Button>
      </Group>
    </Modal>
  );
}
