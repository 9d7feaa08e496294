//! The address space: a folder for each unit, a node for each of its variables.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

use async_trait::async_trait;
use opcua::server::address_space::{AccessLevel, AddressSpace, VariableBuilder, add_namespaces};
use opcua::server::diagnostics::NamespaceMetadata;
use opcua::server::node_manager::memory::InMemoryNodeManagerImpl;
use opcua::server::node_manager::{ParsedReadValueId, RequestContext, ServerContext, WriteNode};
use opcua::sync::RwLock;
use opcua::types::{
    AttributeId, DataTypeId, DataValue, NodeId, ObjectId, QualifiedName, StatusCode, TimestampsToReturn,
    VariableTypeId, VariantScalarTypeId,
};
use plc::outside::Ticket;
use plc::{Variable, VariableAccess, VariableId};
use tokio::time::MissedTickBehavior;

use crate::unit::Unit;
use crate::value::scalar_type;

/// The namespace of the nodes.
pub const NAMESPACE_URI: &str = "urn:ectwin";

/// Sampling interval of monitored values.
const WATCH_PERIOD: Duration = Duration::from_millis(50);

type Nodes = HashMap<NodeId, (Arc<Unit>, VariableId)>;

/// The nodes of all units. A node stores no value: each value is read on request.
pub(crate) struct Line {
    namespace: u16,
    nodes: Arc<Nodes>,
}

impl Line {
    /// Adds the nodes of these units, in the order of the line, to the address space.
    pub(crate) fn new(units: Vec<Unit>, context: &ServerContext, address_space: &mut AddressSpace) -> Self {
        // One namespace requested, one index returned.
        let namespace = add_namespaces(context, address_space, &[NAMESPACE_URI]).pop().unwrap_or_default();
        let mut nodes = Nodes::new();
        for (position, unit) in (1..).zip(units) {
            add_unit(&mut nodes, address_space, namespace, position, Arc::new(unit));
        }
        Self { namespace, nodes: Arc::new(nodes) }
    }

    fn send(
        &self,
        address_space: &RwLock<AddressSpace>,
        write: &WriteNode,
    ) -> Result<(Arc<Unit>, Ticket), StatusCode> {
        let asked = write.value();
        let Some((unit, id)) = self.nodes.get(&asked.node_id) else {
            let is_folder = address_space.read().node_exists(&asked.node_id);
            return Err(if is_folder { StatusCode::BadNotWritable } else { StatusCode::BadNodeIdUnknown });
        };
        if asked.attribute_id != AttributeId::Value {
            return Err(StatusCode::BadNotWritable);
        }
        let value = asked.value.value.as_ref().ok_or(StatusCode::BadTypeMismatch)?;
        Ok((Arc::clone(unit), unit.write(*id, &asked.index_range, value)?))
    }
}

#[async_trait]
impl InMemoryNodeManagerImpl for Line {
    async fn init(&self, _: &mut AddressSpace, context: ServerContext) {
        let nodes = Arc::clone(&self.nodes);
        tokio::spawn(async move {
            let mut ticks = tokio::time::interval(WATCH_PERIOD);
            ticks.set_missed_tick_behavior(MissedTickBehavior::Skip);
            loop {
                ticks.tick().await;
                let values = nodes.keys().map(|node| (node, AttributeId::Value));
                context.subscriptions.maybe_notify(values, |node, _, range, _| {
                    let (unit, id) = nodes.get(node)?;
                    Some(unit.read(*id, range, TimestampsToReturn::Both))
                });
            }
        });
    }

    fn name(&self) -> &str {
        "ectwin"
    }

    fn namespaces(&self) -> Vec<NamespaceMetadata> {
        vec![NamespaceMetadata {
            namespace_uri: NAMESPACE_URI.to_owned(),
            namespace_index: self.namespace,
            ..NamespaceMetadata::default()
        }]
    }

    async fn read_values(
        &self,
        context: &RequestContext,
        address_space: &RwLock<AddressSpace>,
        nodes: &[&ParsedReadValueId],
        max_age: f64,
        timestamps: TimestampsToReturn,
    ) -> Vec<DataValue> {
        let address_space = address_space.read();
        let read = |asked: &&ParsedReadValueId| {
            if asked.attribute_id == AttributeId::Value
                && let Some((unit, id)) = self.nodes.get(&asked.node_id)
            {
                return match address_space.validate_node_read(context, asked) {
                    Ok(_) => unit.read(*id, &asked.index_range, timestamps),
                    Err(status) => DataValue { status: Some(status), ..DataValue::default() },
                };
            }
            address_space.read(context, asked, max_age, timestamps)
        };
        nodes.iter().map(read).collect()
    }

    async fn write(
        &self,
        _: &RequestContext,
        address_space: &RwLock<AddressSpace>,
        nodes: &mut [&mut WriteNode],
    ) -> Result<(), StatusCode> {
        // All changes are sent before the first one is waited for: most requests are executed in one task period.
        let sent: Vec<_> = nodes.iter().map(|write| self.send(address_space, write)).collect();
        for (write, sent) in nodes.iter_mut().zip(sent) {
            write.set_status(match sent {
                Ok((unit, ticket)) => unit.taken(ticket).await,
                Err(status) => status,
            });
        }
        Ok(())
    }
}

fn add_unit(
    nodes: &mut Nodes,
    address_space: &mut AddressSpace,
    namespace: u16,
    position: usize,
    unit: Arc<Unit>,
) {
    // Units of a line may have the same names: the identifiers of the second and later ones begin with the position.
    let node_id = |name: &str| match position {
        1 => NodeId::new(namespace, name.to_owned()),
        _ => NodeId::new(namespace, format!("{position}/{name}")),
    };
    let device_name = unit.variables().device_name();
    let folder = node_id(device_name);
    let objects = ObjectId::ObjectsFolder.into();
    address_space.add_folder(&folder, QualifiedName::new(namespace, device_name), device_name, &objects);
    for (id, variable) in unit.variables().iter() {
        let node = node_id(&variable.name);
        add_variable(address_space, &node, &folder, variable);
        nodes.insert(node, (Arc::clone(&unit), id));
    }
}

fn add_variable(address_space: &mut AddressSpace, node: &NodeId, folder: &NodeId, variable: &Variable) {
    let access = match variable.access {
        VariableAccess::ReadOnly => AccessLevel::CURRENT_READ,
        VariableAccess::ReadWrite => AccessLevel::CURRENT_READ | AccessLevel::CURRENT_WRITE,
    };
    let name = variable.name.as_str();
    let builder = VariableBuilder::new(node, QualifiedName::new(node.namespace, name), name)
        .description(variable.port.as_deref().unwrap_or_default())
        .data_type(data_type(scalar_type(variable.variable_type)))
        .access_level(access)
        .user_access_level(access)
        .has_type_definition(VariableTypeId::BaseDataVariableType)
        .organized_by(folder.clone());
    let builder = match variable.variable_type.elements {
        Some(elements) => builder.value_rank(1).array_dimensions(&[u32::from(elements)]),
        None => builder.value_rank(-1),
    };
    builder.insert(address_space);
}

const fn data_type(scalar_type: VariantScalarTypeId) -> DataTypeId {
    match scalar_type {
        VariantScalarTypeId::Boolean => DataTypeId::Boolean,
        VariantScalarTypeId::Byte => DataTypeId::Byte,
        VariantScalarTypeId::UInt16 => DataTypeId::UInt16,
        VariantScalarTypeId::UInt32 => DataTypeId::UInt32,
        _ => DataTypeId::UInt64,
    }
}
